// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "drift_scene.h"

/// What SolveDrift minimises, and how sure it is of the answer.
namespace sslcd {
namespace {

TEST(Drift, CovarianceIsHonestFarFromTheOrigin) {
  Random random(11);
  for (const bool six_dof : {false, true}) {
    Scene scene;
    scene.middle = Vec3(180, 3, 240);
    scene.position_noise_m = 0.2;
    scene.yaw_noise_rad = 0.05;
    DriftOptions options = FourDof();
    options.six_dof = six_dof;
    options.tilt_sigma_rad = 0.03;
    double nees = 0;
    constexpr int kTrials = 300;
    for (int i = 0; i < kTrials; ++i) {
      scene.D = TurnAndShift(scene.up, random.Uniform(-1, 1), scene.middle, Vec3(3, 0, 1));
      if (six_dof) {
        const Vec3 tilt =
            0.02 * scene.gravity().Basis() * Vec3(random.Normal(1), random.Normal(1), 0);
        scene.D = scene.D *
                  TurnAndShift(Vec3(tilt.normalized()), tilt.norm(), scene.middle, Vec3(0, 0, 0));
      }
      const DriftResult result = SolveDrift(scene.Pairs(random), scene.gravity(), options);
      ASSERT_TRUE(result.usable) << result.reason;
      const Eigen::Matrix<double, 6, 1> d = (result.T_global_local.inverse() * scene.D).Log();
      nees += d.dot(Eigen::Matrix<double, 6, 6>(result.covariance.inverse()) * d) / kTrials;
    }
    const double expected = six_dof ? 6 : 4;
    EXPECT_GT(nees, 0.6 * expected);
    EXPECT_LT(nees, 1.3 * expected);
  }
}

// What SolveDrift promises to minimise: a Cauchy loss on each pair's position (three rows) and
// heading (one), s^2 log(1 + mean square / s^2), and the prior on the vertical.
double RobustCost(const std::vector<DriftPair>& pairs, const Pose& D, const DriftOptions& options) {
  const auto loss = [&](double mean_square) {
    return std::pow(options.loss_scale, 2) *
           std::log1p(mean_square / std::pow(options.loss_scale, 2));
  };
  const Vec3 up = D.so3().inverse() * Vec3(0, 0, 1);
  double cost = up.head<2>().squaredNorm() / std::pow(options.tilt_sigma_rad, 2);
  for (const DriftPair& pair : pairs) {
    const Pose E = pair.T_world_global.inverse() * D * pair.T_world_local;
    const Vec3 heading = E.so3() * Vec3(1, 0, 0);
    cost += 3 * loss(E.translation().squaredNorm() / std::pow(pair.sigma_horizontal_m, 2) / 3);
    cost += loss(std::pow(std::atan2(heading.y(), heading.x()) / pair.sigma_yaw_rad, 2));
  }
  return cost;
}

TEST(Drift, IsAMinimumOfTheCauchyLoss) {
  Random random(4);
  Scene scene;
  scene.up = Vec3(0, 0, 1);
  scene.objects = 7;
  scene.position_noise_m = 0.3;
  scene.yaw_noise_rad = 0.05;
  std::vector<DriftPair> pairs = scene.Pairs(random);
  pairs[0].T_world_global.translation() += Vec3(1.5, 0, 0);  // pulls, but less than by its square
  pairs[1].T_world_global = pairs[1].T_world_global * Pose::RotZ(0.4);
  for (const bool six_dof : {false, true}) {
    for (const double loss_scale : {0.7, 2., 5.}) {
      DriftOptions options;
      options.six_dof = six_dof;
      options.tilt_sigma_rad = 0.05;
      options.loss_scale = loss_scale;
      options.max_iterations = 300;
      const DriftResult result = SolveDrift(pairs, scene.gravity(), options);
      ASSERT_TRUE(result.converged);
      const double least = RobustCost(pairs, result.T_global_local, options);
      for (int i = 0; i < 6; ++i) {
        if (!six_dof && (i == 3 || i == 4)) continue;
        for (const double step : {-1e-3, 1e-3}) {
          Pose::Tangent d = Pose::Tangent::Zero();
          d[i] = i < 3 ? step : 0.1 * step;
          EXPECT_GT(RobustCost(pairs, result.T_global_local * Pose::Exp(d), options), least)
              << "loss scale " << loss_scale << ", component " << i << " by " << d[i];
        }
      }
    }
  }
}

// Poles at the corners of a square, 10 m from its middle, each moved outwards by the same: nothing
// to correct, and residuals whose size is known.
std::vector<DriftPair> Corners(double outwards_m) {
  std::vector<DriftPair> pairs;
  for (const Vec3& corner : {Vec3(10, 0, 0), Vec3(0, 10, 0), Vec3(-10, 0, 0), Vec3(0, -10, 0)})
    pairs.push_back(At(corner, corner * (1 + outwards_m / 10), kNaN, kNaN, Symmetry::kFull));
  return pairs;
}

TEST(Drift, ResidualsWithinTheSigmasLeaveTheCovarianceToThem) {
  const double sigma = DriftPair().sigma_horizontal_m, tilt = FourDof().tilt_sigma_rad;
  const DriftResult result = Solve(Corners(0));
  ASSERT_TRUE(result.usable);
  for (const int axis : {0, 1, 2})
    EXPECT_NEAR(result.covariance(axis, axis), sigma * sigma / 4, 1e-9) << "a mean of four";
  EXPECT_NEAR(result.covariance(5, 5), sigma * sigma / 400, 1e-9) << "four arms of 10 m";
  for (const int axis : {3, 4}) EXPECT_NEAR(result.covariance(axis, axis), tilt * tilt, 1e-12);
}

TEST(Drift, LargerResidualsTakeTheSigmasPlaceInTheCovariance) {
  constexpr double kOff = 0.9;  // three sigmas
  DriftOptions options = FourDof();
  options.loss_scale = 0;
  const DriftResult result =
      SolveDrift(Corners(kOff), GravityFrame::FromUp(Vec3::UnitZ()), options);
  ASSERT_TRUE(result.usable);
  EXPECT_LT(Difference(result.T_global_local, Pose()), 1e-9);
  EXPECT_NEAR(result.rms_m, kOff, 1e-9);
  // Four squares over 12 coordinates less four unknowns, whatever the sigmas promise.
  const double variance = 4 * kOff * kOff / (12 - 4);
  EXPECT_NEAR(result.covariance(0, 0), variance / 4, 1e-9);
  EXPECT_NEAR(result.covariance(5, 5), variance / 400, 1e-9);
  EXPECT_NEAR(result.covariance(3, 3), std::pow(options.tilt_sigma_rad, 2), 1e-12)
      << "the tilt is not measured";
}

// Four poles measure the tilt as well as the prior does: half of a tilt of the local map is taken.
TEST(Drift, TheVerticalIsAPriorOnTheTiltWithoutALoss) {
  DriftOptions options;
  options.six_dof = true;
  options.tilt_sigma_rad = DriftPair().sigma_vertical_m / std::sqrt(2 * 100.);
  const double tilt = 0.05;
  const Pose tilted(lie::SO3<double>::Exp(Vec3(tilt, 0, 0)), Vec3(Vec3::Zero()));
  for (const double loss_scale : {0., 100.}) {
    options.loss_scale = loss_scale;
    std::vector<DriftPair> pairs = Corners(0);
    for (DriftPair& pair : pairs) pair.T_world_local = tilted * pair.T_world_local;
    const DriftResult result = SolveDrift(pairs, GravityFrame::FromUp(Vec3::UnitZ()), options);
    ASSERT_TRUE(result.usable) << result.reason;
    EXPECT_NEAR(result.T_global_local.so3().Log().x(), -tilt / 2, 1e-4);
    EXPECT_NEAR(result.covariance(4, 4), std::pow(options.tilt_sigma_rad, 2) / 2, 1e-6);
  }
}

TEST(Drift, AHeadingSaysNothingOfTheTilt) {
  DriftOptions options = FourDof();
  for (const bool six_dof : {false, true}) {
    options.six_dof = six_dof;
    const DriftResult result = SolveDrift({At({0, 0, 0}, {4, 6, 0}, 0.1, 0.6, Symmetry::kNone)},
                                          GravityFrame::FromUp(Vec3::UnitZ()), options);
    ASSERT_TRUE(result.usable) << result.reason;
    for (const int axis : {3, 4})
      EXPECT_NEAR(result.covariance(axis, axis), std::pow(options.tilt_sigma_rad, 2), 1e-12);
    EXPECT_NEAR(result.covariance(5, 5), std::pow(DriftPair().sigma_yaw_rad, 2), 1e-12);
  }
}

TEST(Drift, AYawLessSureThanMaxYawSigmaIsNotUsable) {
  for (const double share : {0.97, 1.03}) {
    DriftPair car = At({1, 2, 0}, {4, 6, 0}, 0.1, 0.6, Symmetry::kNone);
    car.sigma_yaw_rad = share * kMaxDriftYawSigmaRad;
    const DriftResult result = Solve({car});
    EXPECT_EQ(result.usable, share < 1) << result.reason;
  }
}

TEST(Drift, InliersEndAtInlierSigmas) {
  const double sigma = DriftPair().sigma_horizontal_m;
  DriftOptions options = FourDof();
  for (const auto& [sigmas, inliers] : {std::pair<double, int>{3.4, 4}, {3.6, 0}}) {
    const DriftResult result =
        SolveDrift(Corners(sigmas * sigma), GravityFrame::FromUp(Vec3::UnitZ()), options);
    EXPECT_EQ(result.inliers, inliers);
    EXPECT_NEAR(result.rms_m, inliers > 0 ? sigmas * sigma : 0, 1e-9);
  }
}

// Two poles that are 1.2 m too far apart: the vague one takes nine tenths of it, 3.6 of its sigmas.
TEST(Drift, RmsIsThatOfTheInliers) {
  std::vector<DriftPair> pairs = {At({-5, 0, 0}, {-5.6, 0, 0}, kNaN, kNaN, Symmetry::kFull),
                                  At({5, 0, 0}, {5.6, 0, 0}, kNaN, kNaN, Symmetry::kFull)};
  pairs[0].sigma_horizontal_m = 0.1;
  DriftOptions options = FourDof();
  options.loss_scale = 0;
  const DriftResult result = SolveDrift(pairs, GravityFrame::FromUp(Vec3::UnitZ()), options);
  EXPECT_EQ(result.inliers, 1);
  EXPECT_NEAR(result.rms_m, 0.12, 1e-9);
}

}  // namespace
}  // namespace sslcd
