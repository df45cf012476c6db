// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/resighting.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

namespace sslcd {
namespace {

// How much larger the errors are than the noise as configured.
struct Truth {
  double horizontal = 1, vertical = 1, detection = 1, heading = horizontal;
  double wrong = 0;    // share of wrong matches, which lie anywhere within 5 m
  double freedom = 4;  // of the errors' Student-t distribution
};

// Over 3 to 40 m of path, as objects stay in sight.
std::vector<Resighting> MadeUp(const Truth& truth, unsigned seed, int count = 500) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> chi2(truth.freedom);
  std::uniform_real_distribution<double> uniform;
  std::vector<Resighting> all;
  for (int i = 0; i < count; ++i) {
    Resighting& each = all.emplace_back();
    const double path_m = 3 + 37 * uniform(random);
    each.detection = Vec3(0.02, 0.005, 0.004).asDiagonal();
    each.detection(0, 1) = each.detection(1, 0) = 0.005;
    each.translation = 1e-3 * path_m * Vec3(1, 1, 0.5).asDiagonal();
    each.rotation = 2e-6 * std::pow(path_m, 3) * Vec3(0.2, 1, 1).asDiagonal();
    const Eigen::Matrix3d position =
        Vec3(truth.horizontal, truth.horizontal, truth.vertical).asDiagonal();
    const Eigen::Matrix3d heading = Vec3(truth.heading, truth.heading, truth.vertical).asDiagonal();
    const Eigen::Matrix3d covariance = truth.detection * truth.detection * each.detection +
                                       position * each.translation * position +
                                       heading * each.rotation * heading;
    each.moved = std::sqrt(truth.freedom / chi2(random)) *
                 (Eigen::Matrix3d(covariance.llt().matrixL()) *
                  Vec3(normal(random), normal(random), normal(random)));
    if (uniform(random) < truth.wrong)
      each.moved = 10 * Vec3(uniform(random), uniform(random), uniform(random)) - Vec3(5, 5, 5);
  }
  return all;
}

TEST(FactorsFromResightings, AreThoseOfTheOdometry) {
  for (const auto& [horizontal, vertical] :
       {std::pair(1., 1.), {3., 1.}, {1., 3.}, {0.7, 5.}, {5., 0.7}}) {
    for (const unsigned seed : {1, 2, 3}) {
      const OdometryFactors factors =
          FactorsFromResightings(MadeUp({horizontal, vertical}, seed, 4000));
      EXPECT_NEAR(factors.horizontal / horizontal, 1, 0.15) << horizontal << ", seed " << seed;
      EXPECT_NEAR(factors.vertical / vertical, 1, 0.15) << vertical << ", seed " << seed;
    }
  }
}

// The tails of the likelihood expect large errors.
TEST(FactorsFromResightings, OfGaussianErrorsAreASixthTooSmall) {
  Truth truth{2, 2};
  truth.freedom = 1e6;
  const OdometryFactors factors = FactorsFromResightings(MadeUp(truth, 1, 2000));
  EXPECT_NEAR(factors.horizontal / 2, 5. / 6, 0.05);
  EXPECT_NEAR(factors.vertical / 2, 5. / 6, 0.05);
}

TEST(FactorsFromResightings, HeightAndTiltShareOne) {
  const OdometryFactors factors = FactorsFromResightings(MadeUp({4, 0.5}, 1));
  EXPECT_EQ(factors.tilt, factors.vertical);
  EXPECT_GT(factors.horizontal, 3 * factors.vertical);
}

TEST(FactorsFromResightings, TellHeadingFromBetterPosition) {
  Truth truth;
  truth.horizontal = 0.5;
  truth.heading = 2;
  const OdometryFactors factors = FactorsFromResightings(MadeUp(truth, 1, 1000));
  EXPECT_NEAR(std::log(factors.horizontal / 0.5), 0, 0.5);
  EXPECT_NEAR(std::log(factors.heading / 2), 0, 0.5);
}

// A biased range of the detector looks like errors of position.
TEST(FactorsFromResightings, PoorPositionMayBeTheDetectors) {
  Truth truth;
  truth.horizontal = 2;
  truth.heading = 0.5;
  const OdometryFactors factors = FactorsFromResightings(MadeUp(truth, 1, 1000));
  EXPECT_EQ(factors.horizontal, factors.heading);
}

TEST(FactorsFromResightings, ErrorsOfTheDetectorAreNotTakenForThoseOfOdometry) {
  Truth truth{2, 2};
  const OdometryFactors exact = FactorsFromResightings(MadeUp(truth, 1));
  truth.detection = 2;
  const OdometryFactors poor = FactorsFromResightings(MadeUp(truth, 1));
  EXPECT_NEAR(poor.horizontal / exact.horizontal, 1, 0.15);
  EXPECT_NEAR(poor.vertical / exact.vertical, 1, 0.15);
}

TEST(FactorsFromResightings, AFewWrongMatchesHardlyMatter) {
  for (const unsigned seed : {1, 2, 3}) {
    Truth truth{1, 1};
    const OdometryFactors right = FactorsFromResightings(MadeUp(truth, seed));
    truth.wrong = 0.05;
    const OdometryFactors some = FactorsFromResightings(MadeUp(truth, seed));
    EXPECT_NEAR(some.horizontal / right.horizontal, 1, 0.35) << "seed " << seed;
    EXPECT_NEAR(some.vertical / right.vertical, 1, 0.35) << "seed " << seed;
  }
}

TEST(FactorsFromResightings, OneWithoutAny) {
  const OdometryFactors factors = FactorsFromResightings({});
  EXPECT_EQ(factors.horizontal, 1);
  EXPECT_EQ(factors.heading, 1);
  EXPECT_EQ(factors.vertical, 1);
  EXPECT_EQ(factors.tilt, 1);
}

// Its objects are more exact than odometry; it may still be chance.
TEST(FactorsFromResightings, OneOfThemMovesAFactorLessThanMany) {
  Resighting exact;
  exact.detection = 1e-3 * Eigen::Matrix3d::Identity();
  exact.translation = exact.rotation = 0.5 * Eigen::Matrix3d::Identity();
  exact.moved = Vec3(0.05, 0, 0.05);
  const OdometryFactors one = FactorsFromResightings({exact}),
                        many = FactorsFromResightings(std::vector<Resighting>(50, exact));
  EXPECT_LT(many.horizontal, 0.5 * one.horizontal);
  EXPECT_LT(many.vertical, 0.5 * one.vertical);
}

TEST(FactorsFromResightings, FailuresExplainWhatTheyAdd) {
  std::vector<Resighting> all = MadeUp({1, 1}, 1, 1000);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (Resighting& each : all) {
    each.fixed = 4 * Eigen::Matrix2d::Identity();
    each.moved.head<2>() += 2 * Eigen::Vector2d(normal(random), normal(random));
  }
  const OdometryFactors told = FactorsFromResightings(all);
  EXPECT_NEAR(told.vertical, 1, 0.15);
  EXPECT_LT(told.horizontal, 1.5);
  for (Resighting& each : all) each.fixed.setZero();
  EXPECT_GT(FactorsFromResightings(all).horizontal, 3) << "taken for noise";
}

}  // namespace
}  // namespace sslcd
