// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/cost_functors.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/gradient_checker.h>
#include <ceres/sphere_manifold.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "bundle/ba_costs.h"
#include "bundle/marginal_prior.h"
#include "pose_graph/pose_manifold.h"

namespace sslcd {
namespace {

Pose RandomPose(std::mt19937& random, double angle) {
  const auto u = [&] { return (random() % 20001) / 10000. - 1.; };
  Vec6 xi;
  for (int i = 0; i < 3; ++i) {
    xi[i] = 5 * u();
    xi[i + 3] = angle * u();
  }
  return Pose::Exp(xi);
}

// Where a camera at the pose sees the object, so that residuals are small but not zero.
Pose Seen(const Pose& T_world_cam, const UprightPose& object, const GravityFrame& gravity) {
  Vec6 noise;
  noise << 0.1, -0.2, 0.05, 0.01, 0.02, -0.03;
  return T_world_cam.inverse() * ToPose(object, gravity) * Pose::Exp(noise);
}

void Check(const ceres::CostFunction& cost, const std::vector<const double*>& blocks,
           const std::vector<const ceres::Manifold*>& manifolds) {
  ceres::NumericDiffOptions options;
  const ceres::GradientChecker checker(&cost, &manifolds, options);
  ceres::GradientChecker::ProbeResults results;
  // its own verdict is relative only: entries of 1e-16 fail it
  checker.Probe(blocks.data(), 1e-5, &results);
  ASSERT_TRUE(results.return_value);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Eigen::MatrixXd difference =
        results.local_jacobians[i] - results.local_numeric_jacobians[i];
    const double size = 1 + results.local_numeric_jacobians[i].cwiseAbs().maxCoeff();
    EXPECT_TRUE(difference.cwiseAbs().maxCoeff() <= 1e-6 * size) << "block " << i << "\n"
                                                                 << difference;
  }
}

class Functors : public ::testing::TestWithParam<int> {
 protected:
  std::mt19937 random{static_cast<unsigned>(GetParam())};
  GravityFrame gravity = GravityFrame::FromUp(GetParam() % 2 ? Vec3(0, -1, 0) : Vec3(0.1, 0.2, 1));
  PoseManifold pose_manifold;
  Pose camera = RandomPose(random, 1.5), next = camera * RandomPose(random, 0.3);
  UprightPose object{camera * Vec3(1, 0.5, 12), 0.7};
  double state[4] = {object.position.x(), object.position.y(), object.position.z(), object.yaw};
  double log_scale = 0.03;
  const Vec3 expected{0.5, 0.3, 14};
};

TEST_P(Functors, ObjectResidualGradient) {
  const ObjectResidual residual{
      Seen(camera, object, gravity), expected, {0.3, 0.1, 0.05, 0.02}, M_PI, gravity};
  const ceres::AutoDiffCostFunction<ObjectResidual, 4, 7, 4> cost(new ObjectResidual(residual));
  Check(cost, {camera.data(), state}, {&pose_manifold, nullptr});
}

// A cost with derivatives by hand is the functor that specifies it.
void ExpectSame(const ceres::CostFunction& ours, const ceres::CostFunction& automatic,
                const std::vector<const double*>& blocks) {
  Eigen::VectorXd r(ours.num_residuals()), expected(ours.num_residuals());
  ASSERT_TRUE(ours.Evaluate(blocks.data(), r.data(), nullptr));
  ASSERT_TRUE(automatic.Evaluate(blocks.data(), expected.data(), nullptr));
  EXPECT_TRUE((r - expected).cwiseAbs().maxCoeff() <= 1e-9 * (1 + expected.norm())) << r << "\n"
                                                                                    << expected;
}

TEST_P(Functors, ObjectCostIsObjectResidual) {
  for (const double yaw_period : {0., M_PI, 2 * M_PI}) {
    const ObjectResidual residual{
        Seen(camera, object, gravity), expected, {0.3, 0.1, 0.05, 0.02}, yaw_period, gravity};
    const ObjectCost cost(residual);
    Check(cost, {camera.data(), state}, {&pose_manifold, nullptr});
    ExpectSame(cost,
               ceres::AutoDiffCostFunction<ObjectResidual, 4, 7, 4>(new ObjectResidual(residual)),
               {camera.data(), state});
  }
}

TEST_P(Functors, OdometryCostIsOdometryResidual) {
  const OdometryResidual residual{RandomPose(random, 0.3),
                                  WhiteningOf({0.1, 0.2, 0.01}, {0.5, 3}, gravity.up)};
  const OdometryCost cost(residual);
  Check(cost, {camera.data(), next.data(), &log_scale}, {&pose_manifold, &pose_manifold, nullptr});
  ExpectSame(
      cost,
      ceres::AutoDiffCostFunction<OdometryResidual, 6, 7, 7, 1>(new OdometryResidual(residual)),
      {camera.data(), next.data(), &log_scale});
}

TEST_P(Functors, PaperObjectResidualGradient) {
  const PaperObjectResidual residual{Seen(camera, object, gravity), gravity};
  const ceres::AutoDiffCostFunction<PaperObjectResidual, 6, 7, 4> cost(
      new PaperObjectResidual(residual));
  Check(cost, {camera.data(), state}, {&pose_manifold, nullptr});
}

TEST_P(Functors, OdometryResidualGradient) {
  const OdometryResidual residual{RandomPose(random, 0.3),
                                  WhiteningOf({0.1, 0.2, 0.01}, {0.5, 3}, gravity.up)};
  const ceres::AutoDiffCostFunction<OdometryResidual, 6, 7, 7, 1> cost(
      new OdometryResidual(residual));
  Check(cost, {camera.data(), next.data(), &log_scale}, {&pose_manifold, &pose_manifold, nullptr});
}

TEST_P(Functors, PosePriorGradient) {
  const ceres::AutoDiffCostFunction<PosePrior, 6, 7> cost(new PosePrior{next, 0.1, 0.02});
  Check(cost, {camera.data()}, {&pose_manifold});
}

TEST_P(Functors, SlopeResidualGradient) {
  const Vec3 up_in_cam = next.so3() * Vec3(0, -1, 0);
  const ceres::AutoDiffCostFunction<SlopeResidual, 3, 7, 3> cost(
      new SlopeResidual{up_in_cam, 0.05});
  const ceres::SphereManifold<3> directions;
  Check(cost, {camera.data(), gravity.up.data()}, {&pose_manifold, &directions});
}

TEST_P(Functors, MarginalPriorGradient) {
  BaPrior prior;
  prior.frames = {3};
  prior.object_ids = {8};
  prior.cameras = {next};
  prior.objects = {{object.position + Vec3(0.3, 0, 0.1), object.yaw - 0.2}};
  prior.log_scale = 0.01;
  prior.J = Eigen::MatrixXd::NullaryExpr(9, 11, [&] { return (random() % 2001) / 1000. - 1.; });
  prior.r0 = Eigen::VectorXd::Ones(9);
  Check(MarginalPriorCost(prior), {camera.data(), state, &log_scale},
        {&pose_manifold, nullptr, nullptr});
}

INSTANTIATE_TEST_SUITE_P(Seeds, Functors, ::testing::Range(0, 8));

TEST(ObjectResidual, VanishesAtTheTruthAndKnowsHalfTurns) {
  const GravityFrame gravity;
  const Pose camera = Pose::Trans(1, 0, 2);
  const UprightPose object{Vec3(4, 1, 15), 0.4};
  const double flipped[4] = {4, 1, 15, 0.4 + M_PI};
  const Pose T_cam_object = camera.inverse() * ToPose(object, gravity);
  const Vec3 expected = T_cam_object.translation();
  double r[4];
  ObjectResidual{T_cam_object, expected, {0.1, 0.1, 0.1, 0.1}, M_PI, gravity}(camera.data(),
                                                                              flipped, r);
  for (const double component : r) EXPECT_NEAR(component, 0., 1e-9);
  ObjectResidual{T_cam_object, expected, {0.1, 0.1, 0.1, 0.1}, 2 * M_PI, gravity}(camera.data(),
                                                                                  flipped, r);
  EXPECT_NEAR(std::abs(r[3]), M_PI / 0.1, 1e-6);
  ObjectResidual{T_cam_object, expected, {0.1, 0.1, 0.1, 0.1}, 0, gravity}(camera.data(), flipped,
                                                                           r);
  EXPECT_EQ(r[3], 0.);
}

TEST(ObjectResidual, ComponentsAreRadialLateralVertical) {
  const GravityFrame gravity;
  const Pose camera;
  const UprightPose object{Vec3(0, 0, 10), 0};
  const DetectionSigmas sigmas{0.5, 0.25, 0.125, 1};
  double r[4];
  const auto off = [&](double x, double y, double z) {
    const double state[4] = {x, y, 10 + z, 0};
    ObjectResidual{ToPose(object, gravity), object.position, sigmas, M_PI, gravity}(camera.data(),
                                                                                    state, r);
  };
  off(0, 0, 1);
  EXPECT_NEAR(std::abs(r[0]), 2, 1e-9);
  EXPECT_NEAR(r[1], 0, 1e-9);
  off(1, 0, 0);
  EXPECT_NEAR(std::abs(r[1]), 4, 1e-9);
  off(0, 1, 0);
  EXPECT_NEAR(std::abs(r[2]), 8, 1e-9);
}

TEST(ObjectResidual, RayIsThatOfTheExpectedPlaceNotOfTheMeasurement) {
  const Pose camera, measured = Pose::Trans(3, 0, 10);
  const double state[4] = {0, 0, 10, 0};
  double r[4];
  ObjectResidual{measured, Vec3(0, 0, 20), {1, 1, 1, 1}, 0, {}}(camera.data(), state, r);
  EXPECT_NEAR(r[0], 0, 1e-12);
  EXPECT_NEAR(std::abs(r[1]), 3, 1e-12);
}

TEST(SlopeResidual, IsTheSlopeInSigmasWhicheverWayTheCameraLooks) {
  const Vec3 up(0, -1, 0);
  const SlopeResidual residual{up, 0.05};
  for (const double heading : {0., 1., 3.}) {
    const Pose camera = Pose::Trans(5, 2, 1) * Pose::RotY(heading) * Pose::RotX(0.1);
    Eigen::Vector3d r;
    residual(camera.data(), up.data(), r.data());
    EXPECT_NEAR(r.norm(), 2, 1e-3);
  }
}

TEST(OdometryResidual, ScaleStretchesTranslationOnly) {
  Vec6 xi;
  xi << 1, 0.2, 0.3, 0.1, -0.2, 0.05;
  const Pose odometry = Pose::Exp(xi);
  const Pose metric(odometry.so3(), odometry.translation() * 0.97);
  const Pose from;
  const double log_scale = std::log(0.97);
  double r[6];
  OdometryResidual{odometry, WhiteningOf({0.1, 0.1, 0.1}, {}, Vec3::UnitZ())}(
      from.data(), metric.data(), &log_scale, r);
  for (const double component : r) EXPECT_NEAR(component, 0, 1e-9);
}

TEST(OdometryResidual,
     IsInTheOdometrysOwnUnits) {  // else a small scale would make small noise of large
  const Pose odometry = Pose::Trans(1, 0, 0), from, to = Pose::Trans(2.2, 0, 0);
  const double log_scale = std::log(2.);
  double r[6];
  OdometryResidual{odometry, WhiteningOf({0.1, 0.1, 0.1}, {}, Vec3::UnitZ())}(
      from.data(), to.data(), &log_scale, r);
  EXPECT_NEAR(r[0], 1, 1e-9) << "the odometry says 1 m where it was 1.1 m: one sigma";
}

}  // namespace
}  // namespace sslcd
