// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/map/motion_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

}  // namespace
}  // namespace sslcd
