// SPDX-License-Identifier: BSD-3-Clause
#include "map/motion_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace sslcd {
namespace {

// Positions of an object that moves with `speed` along x, seen 10 times a second with noise
// `sigma`.
MotionTest Watch(double speed, double sigma, int frames, unsigned seed) {
  std::mt19937 random(seed);
  const auto gauss = [&] {  // sum of twelve uniforms
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += (random() % 100000) / 100000.;
    return sum;
  };
  MotionTest test;
  const Eigen::Matrix2d covariance = sigma * sigma * Eigen::Matrix2d::Identity();
  for (int i = 0; i < frames; ++i)
    test.Add(Vec2(speed * 0.1 * i + sigma * gauss(), sigma * gauss()), covariance, 0.1 * i, {});
  return test;
}

TEST(MotionTest, ParkedIsParked) {
  for (const double sigma : {0.1, 0.5, 1.}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const MotionTest test = Watch(0, sigma, 40, seed);
      EXPECT_NE(test.Verdict({}), Motion::kDriving) << "sigma " << sigma << " seed " << seed;
      if (sigma > 0.5) continue;
      EXPECT_EQ(test.Verdict({}), Motion::kParked) << "sigma " << sigma << " seed " << seed;
    }
  }
}

TEST(MotionTest, DrivingIsDriving) {
  for (const double speed : {2., 5., 15., -10.}) {
    for (unsigned seed = 0; seed < 20; ++seed)
      EXPECT_EQ(Watch(speed, 0.3, 25, seed).Verdict({}), Motion::kDriving)
          << "speed " << speed << " seed " << seed;
  }
}

TEST(MotionTest, OneSightingDecidesNothing) {
  EXPECT_EQ(Watch(0, 0.1, 1, 1).Verdict({}), Motion::kUndecided);
}

TEST(MotionTest,
     ACreepingBiasIsNotDriving) {  // a detector's bias turns with the viewing ray: 1 m in 4 s
  EXPECT_NE(Watch(0.25, 0.1, 40, 1).Verdict({}), Motion::kDriving);
}

TEST(MotionTest, PredictsWithTheRightModel) {
  const MotionTest test = Watch(10, 0.1, 20, 3);
  EXPECT_NEAR(test.PredictDriving(2.9, {}).position.x(), 29., 1.);
  EXPECT_NEAR(test.velocity().x(), 10., 0.5);
}

TEST(MotionTest, ADrivingObjectThatStopsIsNoticedAndForgiven) {
  MotionTest test = Watch(5, 0.1, 20, 4);
  ASSERT_EQ(test.Verdict({}), Motion::kDriving);
  for (int i = 20; i < 60; ++i)
    test.Add(Vec2(9.5, 0), 0.01 * Eigen::Matrix2d::Identity(), 0.1 * i, {});
  EXPECT_GT(test.Stamp() - test.StandingSince(), 1.5);
  test.Restart();
  EXPECT_NE(test.Verdict({}), Motion::kDriving);
}

TEST(MotionTest, ALongGapStartsAnew) {
  MotionTest test = Watch(0, 0.1, 20, 5);
  test.Add(Vec2(50, 0), 0.01 * Eigen::Matrix2d::Identity(), 100., {});
  EXPECT_NE(test.Verdict({}), Motion::kDriving);
  EXPECT_NEAR(test.PredictParked(100., {}).position.x(), 50., 1e-9);
}

TEST(MotionTest, ShiftMovesBothModels) {
  MotionTest test = Watch(0, 0.1, 20, 6);
  const double x = test.PredictParked(2., {}).position.x(),
               driving = test.PredictDriving(2., {}).position.x();
  test.Shift(Vec2(3, 0));
  EXPECT_NEAR(test.PredictParked(2., {}).position.x(), x + 3, 1e-12);
  EXPECT_NEAR(test.PredictDriving(2., {}).position.x(), driving + 3, 1e-12);
}

// Bars out of the way, so that one alone decides; and nothing known of a speed, so that the
// driving model follows each sighting.
MotionTestOptions OnlyTheNoise() {
  MotionTestOptions options;
  options.speed_prior_mps = 1e4;
  options.decide_at = -100;
  options.min_travel_m = 0;
  options.min_speed_mps = 0;
  return options;
}

Motion VerdictOfTwo(double apart_m, double seconds, double sigma,
                    const MotionTestOptions& options) {
  MotionTest test;
  const Eigen::Matrix2d covariance = sigma * sigma * Eigen::Matrix2d::Identity();
  test.Add(Vec2(0, 0), covariance, 100, options);
  test.Add(Vec2(0, apart_m), covariance, 100 + seconds, options);
  return test.Verdict(options);
}

TEST(MotionTest, ADistanceWithinTwoSigmasIsNoJourney) {  // sigma of a difference: sqrt(2)
  const double limit = 2 * std::sqrt(2.);
  EXPECT_NE(VerdictOfTwo(0.98 * limit, 1, 1, OnlyTheNoise()), Motion::kDriving);
  EXPECT_EQ(VerdictOfTwo(1.02 * limit, 1, 1, OnlyTheNoise()), Motion::kDriving);
}

TEST(MotionTest, DrivingTakesADistanceAndASpeed) {
  MotionTestOptions options = OnlyTheNoise();
  options.min_travel_m = 2;
  EXPECT_NE(VerdictOfTwo(1.9, 1, 0.01, options), Motion::kDriving);
  EXPECT_EQ(VerdictOfTwo(2.1, 1, 0.01, options), Motion::kDriving);
  options.min_speed_mps = 0.7;
  EXPECT_EQ(VerdictOfTwo(2.1, 2.9, 0.01, options), Motion::kDriving);
  EXPECT_NE(VerdictOfTwo(2.1, 3.1, 0.01, options), Motion::kDriving);
}

TEST(MotionTest, TheFactorIsTheRatioOfBothDensities) {
  MotionTestOptions options;
  options.memory = 100;
  constexpr double kSigma = 0.3, kSeconds = 0.5, kApart = 0.8;
  MotionTest test;
  const Eigen::Matrix2d covariance = kSigma * kSigma * Eigen::Matrix2d::Identity();
  test.Add(Vec2(0, 0), covariance, 0, options);
  EXPECT_EQ(test.log_bayes_factor(), 0);
  test.Add(Vec2(0, kApart), covariance, kSeconds, options);
  // Variance of the second sighting about the first: both noises, and what the model adds.
  const double noise = 2 * kSigma * kSigma;
  const double parked = noise + std::pow(options.wander_m_per_sqrt_s, 2) * kSeconds;
  const double driving = noise + std::pow(options.speed_prior_mps * kSeconds, 2) +
                         std::pow(0.5 * options.acceleration_mps2 * kSeconds * kSeconds, 2);
  const auto log_density = [](double variance) {
    return -0.5 * kApart * kApart / variance - std::log(variance);  // two components
  };
  EXPECT_NEAR(test.log_bayes_factor(), log_density(driving) - log_density(parked), 1e-9);
}

// The same filters for one coordinate, written out.
TEST(MotionTest, BothModelsAreKalmanFilters) {
  MotionTestOptions options;
  constexpr double kVariance = 0.09;
  const double wander = std::pow(options.wander_m_per_sqrt_s, 2),
               acceleration = std::pow(options.acceleration_mps2, 2);
  MotionTest test;
  double parked = 0, parked_variance = 0, at = 0, speed = 0, at_at = 0, at_speed = 0, speed_2 = 0;
  double last = 0;
  for (const auto& [stamp, x] :
       {std::pair<double, double>{10, 1}, {10.5, 1.7}, {11.5, 4}, {12, 4.2}}) {
    const double dt = stamp - last;
    if (stamp == 10) {
      parked = at = x;
      parked_variance = at_at = kVariance;
      speed_2 = std::pow(options.speed_prior_mps, 2);
    } else {
      parked_variance += wander * dt;
      at_at += 2 * dt * at_speed + dt * dt * speed_2 + std::pow(dt, 4) / 4 * acceleration;
      at_speed += dt * speed_2 + std::pow(dt, 3) / 2 * acceleration;
      speed_2 += dt * dt * acceleration;
      at += dt * speed;
      ASSERT_NEAR(test.PredictParked(stamp, options).covariance(0, 0), parked_variance, 1e-9);
      ASSERT_NEAR(test.PredictDriving(stamp, options).position.x(), at, 1e-9);
      ASSERT_NEAR(test.PredictDriving(stamp, options).covariance(0, 0), at_at, 1e-9);
      const double error = x - at, total = at_at + kVariance;
      at += at_at / total * error;
      speed += at_speed / total * error;
      speed_2 -= at_speed * at_speed / total;
      at_speed -= at_at * at_speed / total;
      at_at -= at_at * at_at / total;
      parked += parked_variance / (parked_variance + kVariance) * (x - parked);
      parked_variance *= kVariance / (parked_variance + kVariance);
    }
    test.Add(Vec2(x, 0), kVariance * Eigen::Matrix2d::Identity(), stamp, options);
    EXPECT_NEAR(test.PredictParked(stamp, options).position.x(), parked, 1e-9);
    EXPECT_NEAR(test.velocity().x(), speed, 1e-9);
    last = stamp;
  }
}

TEST(MotionTest, OneWildDetectionSaysNoMoreThanFourSigmas) {
  MotionTestOptions options;
  options.memory = 100;
  const auto factor = [&](double apart_m) {
    MotionTest test;
    const Eigen::Matrix2d covariance = 0.01 * Eigen::Matrix2d::Identity();
    test.Add(Vec2(0, 0), covariance, 0, options);
    test.Add(Vec2(apart_m, 0), covariance, 0.1, options);
    return test.log_bayes_factor();
  };
  EXPECT_NEAR(factor(100), factor(1000), 1e-9);
  const double limit = 4 * std::sqrt(0.02 + 0.1 * std::pow(options.wander_m_per_sqrt_s, 2));
  EXPECT_GT(factor(limit), factor(0.99 * limit));
  EXPECT_GT(factor(limit), factor(1.01 * limit)) << "only driving explains the rest a little worse";
  EXPECT_GT(factor(0.5), factor(0.4));
}

TEST(MotionTest, MemoryLimitsTheFactorOnBothSides) {
  MotionTestOptions options;
  options.memory = 3;
  MotionTest parked, driving;
  const Eigen::Matrix2d covariance = 0.01 * Eigen::Matrix2d::Identity();
  for (int i = 0; i < 20; ++i) {
    parked.Add(Vec2(0, 0), covariance, 0.1 * i, options);
    driving.Add(Vec2(i, 0), covariance, 0.1 * i, options);
  }
  EXPECT_EQ(parked.log_bayes_factor(), -3);
  EXPECT_EQ(driving.log_bayes_factor(), 3);
}

TEST(MotionTest, AtRestThePredictionsWidenWithTime) {
  MotionTestOptions options;
  MotionTest test;
  test.Add(Vec2(1, 2), 0.04 * Eigen::Matrix2d::Identity(), 10, options);
  for (const double dt : {0., 1., 4.}) {
    const MotionTest::Prediction parked = test.PredictParked(10 + dt, options),
                                 driving = test.PredictDriving(10 + dt, options);
    EXPECT_EQ(parked.position, Vec2(1, 2));
    EXPECT_NEAR(parked.covariance(0, 0), 0.04 + std::pow(options.wander_m_per_sqrt_s, 2) * dt,
                1e-12);
    EXPECT_NEAR(driving.covariance(1, 1),
                0.04 + std::pow(options.speed_prior_mps * dt, 2) +
                    std::pow(0.5 * options.acceleration_mps2 * dt * dt, 2),
                1e-9);
  }
  const double forgotten = options.forget_after_s;
  EXPECT_EQ(test.PredictParked(1000, options).covariance,
            test.PredictParked(10 + forgotten, options).covariance)
      << "no further than until it is forgotten";
  EXPECT_EQ(test.PredictDriving(1000, options).covariance,
            test.PredictDriving(10 + forgotten, options).covariance);
}

TEST(MotionTest, SeenAfterLongerThanForgetAfterItStartsAgain) {
  MotionTestOptions options;
  for (const double gap : {4.9, 5., 5.1}) {
    MotionTest test;
    test.Add(Vec2(0, 0), 0.01 * Eigen::Matrix2d::Identity(), 100, options);
    test.Add(Vec2(50, 0), 0.01 * Eigen::Matrix2d::Identity(), 100 + gap, options);
    EXPECT_EQ(test.velocity() == Vec2(0, 0), gap > options.forget_after_s);
  }
}

TEST(MotionTest, AJourneyBeginsWhereTheObjectStoodLast) {
  MotionTestOptions options;
  MotionTest test;
  double x = 0, stamp = 0;
  const auto drive = [&](double speed, double seconds) {
    for (int i = 0; i < 10 * seconds; ++i, stamp += 0.1, x += 0.1 * speed)
      test.Add(Vec2(x, 0), 1e-4 * Eigen::Matrix2d::Identity(), stamp, options);
  };
  drive(10, 2);
  ASSERT_EQ(test.Verdict(options), Motion::kDriving);
  drive(0, 3);
  EXPECT_NE(test.Verdict(options), Motion::kDriving) << "it has settled";
  const double stopped_at = test.StandingSince();
  EXPECT_NEAR(stopped_at, 2, 0.5);
  drive(10, 0.15);
  EXPECT_NE(test.Verdict(options), Motion::kDriving) << "not 2 m yet, counted from the new place";
  drive(10, 1);
  EXPECT_EQ(test.Verdict(options), Motion::kDriving);
}

TEST(MotionTest, AShiftIsNoJourney) {
  MotionTestOptions options = OnlyTheNoise();
  options.max_parked_speed_mps = 1e6;
  for (const double shift : {0., 50.}) {
    MotionTest test;
    for (const double stamp : {100., 101.})
      test.Add(Vec2(0, 0), Eigen::Matrix2d::Identity(), stamp, options);
    test.Shift(Vec2(shift, -shift));
    EXPECT_EQ(test.Verdict(options), Motion::kParked);
  }
}

TEST(MotionTest, RestartForgetsWhatSpokeForDriving) {
  MotionTest test = Watch(5, 0.1, 20, 4);
  ASSERT_GT(test.log_bayes_factor(), 0);
  test.Restart();
  EXPECT_EQ(test.log_bayes_factor(), 0);
  EXPECT_NEAR(test.PredictParked(test.Stamp(), {}).position.x(), 9.5, 0.3) << "where it is now";
}

// Of an object seen once, only the prior of the speed is known.
TEST(MotionTest, TheLargestParkedSpeedIncludesOneSigma) {
  MotionTestOptions options;
  for (const double share : {0.95, 1.05}) {
    options.speed_prior_mps = share * options.max_parked_speed_mps;
    MotionTest test;
    test.Add(Vec2(0, 0), 0.01 * Eigen::Matrix2d::Identity(), 100, options);
    EXPECT_EQ(test.Verdict(options), share < 1 ? Motion::kParked : Motion::kUndecided);
  }
}

// A memory this short keeps the factor on the side of driving, but below the decision.
TEST(MotionTest, WhatSeemsToDriveIsParkedOnlyIfItHardlyGetsAnywhere) {
  MotionTestOptions options;
  options.memory = 0.5;
  options.settle_s = 100;
  for (const double speed : {0.5, 1.}) {
    MotionTest test;
    for (int i = 0; i <= 40; ++i)
      test.Add(Vec2(0.1 * i * speed, 0), 1e-4 * Eigen::Matrix2d::Identity(), 0.1 * i, options);
    ASSERT_EQ(test.log_bayes_factor(), options.memory);
    EXPECT_EQ(test.Verdict(options),
              speed < options.min_speed_mps ? Motion::kParked : Motion::kUndecided);
  }
}

TEST(MotionTest, ParkedOnceTheSpeedIsSurelyLow) {
  MotionTestOptions options;
  MotionTest test;
  const Eigen::Matrix2d covariance = 0.01 * Eigen::Matrix2d::Identity();
  test.Add(Vec2(0, 0), covariance, 0, options);
  EXPECT_EQ(test.Verdict(options), Motion::kUndecided) << "it may have any speed";
  for (int i = 1; i <= 20; ++i) test.Add(Vec2(0, 0), covariance, 0.1 * i, options);
  EXPECT_EQ(test.Verdict(options), Motion::kParked);
  options.max_parked_speed_mps = 0.01;
  EXPECT_EQ(test.Verdict(options), Motion::kUndecided);
}

}  // namespace
}  // namespace sslcd
