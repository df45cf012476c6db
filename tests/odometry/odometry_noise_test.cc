// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

TEST(OdometryNoise, HeightHasAWalkOfItsOwn) {
  OdometryNoise noise;
  noise.translation_floor_m = 0.3;
  noise.translation_walk = 0.04;
  noise.vertical_walk = 0.08;
  const OdometrySigmas sigmas = SigmasOf(Pose::Trans(0, 0, 100), noise);
  EXPECT_NEAR(sigmas.horizontal, 0.5, 1e-12);
  EXPECT_NEAR(sigmas.vertical, std::hypot(0.3, 0.8), 1e-12);
}

TEST(OdometryNoise, InformationIsThatOfTheAxes) {
  Eigen::Matrix<double, 6, 1> expected;
  expected << 100, 25, 100, 1e4, 1e4, 1e4;  // camera axes: y is down
  const auto information = InformationOf({0.1, 0.2, 0.01}, Vec3(0, -1, 0));
  EXPECT_TRUE(information.isApprox(Eigen::Matrix<double, 6, 6>(expected.asDiagonal()), 1e-12))
      << information;
}

TEST(OdometryNoise, FactorsAreOnTheHorizontalPartTheHeadingTheHeightAndTheTilt) {
  const OdometryWhitening whitening = WhiteningOf({0.1, 0.2, 0.01}, {2, 5, 10, 4}, Vec3::UnitZ());
  EXPECT_TRUE(whitening.translation.diagonal().isApprox(Vec3(5, 5, 0.5), 1e-12));
  EXPECT_TRUE(whitening.rotation.diagonal().isApprox(Vec3(25, 25, 20), 1e-12));
  const auto information = InformationOf({0.1, 0.2, 0.01}, Vec3::UnitZ(), {2, 5, 10, 4});
  Eigen::Matrix<double, 6, 1> expected;
  expected << 25, 25, 0.25, 625, 625, 400;
  EXPECT_TRUE(information.diagonal().isApprox(expected, 1e-12)) << information;
}

TEST(SigmasOf, FailuresAddTheirVariance) {
  const Pose step = Pose::Trans(0, 0, 4);
  const OdometrySigmas usual = SigmasOf(step, {}), failed = SigmasOf(step, {}, {9, 0.25});
  EXPECT_NEAR(failed.horizontal, std::hypot(usual.horizontal, 3), 1e-12);
  EXPECT_NEAR(failed.vertical, std::hypot(usual.vertical, 3), 1e-12);
  EXPECT_NEAR(failed.rotation, std::hypot(usual.rotation, 0.5), 1e-12);
}

TEST(FactorsWithFailures, AreOnTheNoiseAlone) {
  const Pose step = Pose::Trans(0, 0, 4);
  const OdometryFactors factors{3, 5, 7, 11};
  const OdometrySigmas usual = SigmasOf(step, {}), failed = SigmasOf(step, {}, {9, 0.25});
  EXPECT_EQ(FactorsWithFailures(factors, usual).horizontal, 3);
  EXPECT_EQ(FactorsWithFailures(factors, usual).heading, 5);
  const OdometryFactors on_sum = FactorsWithFailures(factors, failed);
  EXPECT_NEAR(on_sum.horizontal * failed.horizontal, std::hypot(3 * usual.horizontal, 3), 1e-12);
  EXPECT_NEAR(on_sum.heading * failed.rotation, std::hypot(5 * usual.rotation, 0.5), 1e-12);
  EXPECT_EQ(on_sum.vertical, 7) << "an odometry that keeps its height keeps it in a failure, too";
  EXPECT_EQ(on_sum.tilt, 11);
  const auto information = InformationOf(failed, Vec3::UnitZ(), factors);
  EXPECT_NEAR(1 / information(0, 0), std::pow(on_sum.horizontal * failed.horizontal, 2), 1e-9);
  EXPECT_NEAR(1 / information(5, 5), std::pow(on_sum.heading * failed.rotation, 2), 1e-9);
  EXPECT_NEAR(1 / information(3, 3), std::pow(11 * failed.rotation, 2), 1e-6);
}

TEST(FactorsWithFailures, OfAFailureThatIsFarLargerThanTheNoise) {
  const OdometrySigmas sigmas = SigmasOf(Pose::Trans(0, 0, 1), {}, {1e6, 10});
  for (const double factor : {0.1, 10.}) {
    const OdometryFactors on_sum = FactorsWithFailures({factor, factor}, sigmas);
    EXPECT_NEAR(on_sum.horizontal, 1, 1e-6);
    EXPECT_NEAR(on_sum.heading, 1, 1e-3);
  }
}

}  // namespace
}  // namespace sslcd
