// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/path_variance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sslcd {
namespace {

// A straight drive of 1 m a camera past objects on both sides, all without error.
BaProblem Street(int cameras) {
  BaProblem problem;
  for (int i = 0; i < cameras; ++i) problem.cameras.push_back({i, Pose::Trans(0, 0, i)});
  for (int i = 1; i < cameras; ++i) problem.odometry.push_back({i - 1, i, Pose::Trans(0, 0, 1)});
  for (int k = 0; k < cameras / 3; ++k) {
    problem.objects.push_back({100 + k, Symmetry::kFull, {Vec3(k % 2 ? 4 : -4, 1, 3. * k + 6), 0}});
    for (int i = 0; i < cameras; ++i) {
      const Pose seen = problem.cameras[i].T_world_cam.inverse() *
                        ToPose(problem.objects.back().pose, problem.gravity);
      if (seen.translation().z() > 2 && seen.translation().z() < 15)
        problem.sightings.push_back({i, k, seen});
    }
  }
  return problem;
}

Eigen::Matrix3Xd Only(int camera, int cameras, const Vec3& direction) {
  Eigen::Matrix3Xd function = Eigen::Matrix3Xd::Zero(3, cameras);
  function.col(camera) = direction;
  return function;
}

BaOptions Exact() {
  BaOptions options;
  options.loss_scale = 0;
  options.odometry.scale_prior = 0;
  options.odometry.rotation_floor_rad = 1e-7;
  options.odometry.rotation_walk = options.odometry.rotation_turn = 0;
  return options;
}

// A narrow loss gives ordinary errors little weight, but they tell as much as before.
TEST(PathVariances, DoNotDependOnTheLoss) {
  BaProblem problem = Street(11);
  for (BaSighting& sighting : problem.sightings)
    sighting.T_cam_object.translation() += Vec3(0.1, 0, 0.3);
  BaOptions narrow, none;
  narrow.loss_scale = 0.1;
  none.loss_scale = 0;
  const std::vector<Eigen::Matrix3Xd> last = {Only(10, 11, Vec3::UnitZ())};
  const auto variances = PathVariances(problem, narrow, last);
  ASSERT_TRUE(variances.has_value());
  EXPECT_DOUBLE_EQ(variances->front(), PathVariances(problem, none, last).value().front());
}

// Variances of the steps add up; without objects nothing else does.
TEST(PathVariances, OfAnOdometryAloneAreSumsOverItsSteps) {
  BaProblem problem = Street(11);
  problem.objects.clear();
  problem.sightings.clear();
  const BaOptions options = Exact();
  const OdometrySigmas step = SigmasOf(Pose::Trans(0, 0, 1), options.odometry);
  const auto variances = PathVariances(problem, options,
                                       {Only(10, 11, Vec3::UnitX()), Only(4, 11, Vec3(0, 0, 2)),
                                        Only(10, 11, Vec3::UnitX()) - Only(6, 11, Vec3::UnitX())});
  ASSERT_TRUE(variances.has_value());
  const double gauge = 1e-6;  // of the first camera [m^2]
  EXPECT_NEAR((*variances)[0], 10 * step.horizontal * step.horizontal + gauge, 2e-6);
  EXPECT_NEAR((*variances)[1], 4 * (4 * step.horizontal * step.horizontal + gauge), 1e-5);
  EXPECT_NEAR((*variances)[2], 4 * step.horizontal * step.horizontal, 1e-6);
}

TEST(PathVariances, ObjectsMakeThemSmaller) {
  BaProblem with = Street(30), without = with;
  without.objects.clear();
  without.sightings.clear();
  const BaOptions options = Exact();
  const std::vector<Eigen::Matrix3Xd> end{Only(29, 30, Vec3::UnitX())};
  EXPECT_LT((*PathVariances(with, options, end))[0], (*PathVariances(without, options, end))[0]);
}

TEST(PathVariances, ThereAreNoneWhereAResidualIsNotFinite) {
  BaProblem problem = Street(11);
  problem.objects[1].pose.position.x() = std::nan("");
  EXPECT_FALSE(PathVariances(problem, {}, {Only(10, 11, Vec3::UnitX())}).has_value());
}

// Disturbs all measurements by their noise, optimises, and compares the scatter of the last camera.
TEST(PathVariances, AreTheScatterOfManyRuns) {
  const BaProblem truth = Street(20);
  BaOptions options = Exact();
  options.correlation = 1;
  options.odometry.translation_walk = 0.1;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double sum = 0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    BaProblem problem = truth;
    for (BaSighting& sighting : problem.sightings) {
      const DetectionSigmas s =
          SigmasAt(sighting.T_cam_object.translation().norm(), problem.noise, problem.noise_scale);
      const Vec3 error(s.radial * normal(random), s.lateral * normal(random),
                       s.vertical * normal(random));
      sighting.T_cam_object.translation() +=
          RayFrame(sighting.T_cam_object.translation()).transpose() * error;
    }
    for (BaOdometry& step : problem.odometry) {
      const OdometrySigmas s = SigmasOf(step.T_from_to, options.odometry);
      step.T_from_to.translation() +=
          Vec3(s.horizontal * normal(random), s.vertical * normal(random),
               s.horizontal * normal(random));
    }
    ASSERT_TRUE(SolveBa(problem, options).usable);
    sum += std::pow(problem.cameras[19].T_world_cam.translation().x(), 2) / kRuns;
  }
  const auto variances = PathVariances(truth, options, {Only(19, 20, Vec3::UnitX())});
  ASSERT_TRUE(variances.has_value());
  EXPECT_NEAR(sum / (*variances)[0], 1, 0.4);
}

}  // namespace
}  // namespace sslcd
