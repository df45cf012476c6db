// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/cost.h"

#include <ceres/gradient_checker.h>
#include <ceres/manifold_test_utils.h>
#include <gtest/gtest.h>
#include <lie/se3_map.h>

#include "pose_graph/pose_manifold.h"
#include "pose_graph_world.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

const Vec3 kUp = Vec3(0.1, -0.9, 0.3).normalized();

Pose SomePose(PoseNoise& noise) {
  Vec6 v;
  for (int i = 0; i < 6; ++i) v[i] = noise.Uniform(-1.5, 1.5);
  return Pose::Exp(v);
}

PoseGraph::Edge SomeEdge(PoseNoise& noise) {
  PoseGraph::Edge edge;
  edge.T_from_to = SomePose(noise);
  Eigen::Matrix<double, 6, 6> root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = noise.Normal();
  edge.information = root * root.transpose() + Eigen::Matrix<double, 6, 6>::Identity();
  return edge;
}

TEST(EdgeCost, SquaredNormIsChi2) {
  PoseNoise noise(3);
  for (int i = 0; i < 20; ++i) {
    const PoseGraph::Edge edge = SomeEdge(noise);
    const Pose from = SomePose(noise), to = SomePose(noise);
    const double weight = 0.3;
    Eigen::Matrix<double, 6, 1> r;
    const double* poses[] = {from.data(), to.data()};
    ASSERT_TRUE(EdgeCost(edge, &weight).Evaluate(poses, r.data(), nullptr));
    const Vec6 e = EdgeError(edge, from, to);
    const double chi2 = e.dot(edge.information * e);
    EXPECT_NEAR(r.squaredNorm(), weight * chi2, 1e-9 * (1 + chi2));
  }
}

TEST(EdgeWithin, StaysPositiveDefiniteWithoutInformationOnYaw) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  PoseNoise noise(5);
  for (const PoseFreedom freedom : {PoseFreedom::kUpright, PoseFreedom::kPlanar}) {
    for (const double position : {1e-3, 1., 1e3}) {
      for (int i = 0; i < 50; ++i) {
        PoseGraph::Edge edge = SomeEdge(noise);
        Vec6 diagonal = Vec6::Constant(1e-9 * position);
        diagonal.head<3>().setConstant(position);
        edge.information = diagonal.asDiagonal();
        const auto within = EdgeWithin(freedom, kUp, edge, SomePose(noise), SomePose(noise));
        const Matrix6 information = within.information;
        ASSERT_EQ(information.llt().info(), Eigen::Success) << position << ", " << i;
        if (freedom == PoseFreedom::kPlanar) continue;
        EXPECT_NEAR(information(0, 0), position, 1e-5) << "what the edge knows is kept";
      }
    }
  }
}

TEST(EdgeCost, DerivativesOnBothManifolds) {
  PoseNoise noise(4);
  const double weight = 0.7;
  PoseManifold full;
  UprightManifold upright(GravityFrame::FromUp(kUp), false),
      planar(GravityFrame::FromUp(kUp), true);
  for (const ceres::Manifold* manifold :
       std::initializer_list<const ceres::Manifold*>{&full, &upright, &planar}) {
    for (int i = 0; i < 20; ++i) {
      const Pose from = SomePose(noise);
      const PoseGraph::Edge edge = SomeEdge(noise);
      // Also where the error is small; not where half a turn, at which Log jumps, is within the
      // differences' reach.
      const Pose other = SomePose(noise);
      const Pose to = i == 0 ? from * edge.T_from_to * Pose::Exp(1e-3 * Vec6(other.Log())) : other;
      if (EdgeError(edge, from, to).tail<3>().norm() > 2.3) continue;
      const EdgeCost cost(edge, &weight);
      const std::vector<const ceres::Manifold*> manifolds = {manifold, manifold};
      const ceres::GradientChecker checker(&cost, &manifolds, ceres::NumericDiffOptions());
      ceres::GradientChecker::ProbeResults results;
      const double* poses[] = {from.data(), to.data()};
      EXPECT_TRUE(checker.Probe(poses, 1e-5, &results)) << results.error_log;
    }
  }
}

TEST(UprightManifold, Invariants) {
  PoseNoise noise(5);
  for (const bool planar : {false, true}) {
    const UprightManifold manifold(GravityFrame::FromUp(kUp), planar);
    for (int i = 0; i < 20; ++i) {
      const Pose pose = SomePose(noise);
      const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(pose.data(), 7);
      Eigen::VectorXd delta(manifold.TangentSize()), y(7);
      for (Eigen::Index k = 0; k < delta.size(); ++k) delta[k] = noise.Uniform(-1, 1);
      ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), y.data()));
      EXPECT_THAT(manifold, ceres::MinusPlusIsIdentityAt(x, delta, 1e-9));
      EXPECT_THAT(manifold, ceres::MinusPlusJacobianIsIdentityAt(x, 1e-9));
      EXPECT_THAT(manifold, ceres::HasCorrectPlusJacobianAt(x, 1e-6));
      // What it must not move: the direction of up seen from the pose; the height when planar.
      const Pose moved = lie::SE3ConstMap<double>(y.data());
      EXPECT_NEAR((moved.so3().inverse() * kUp - pose.so3().inverse() * kUp).norm(), 0, 1e-12);
      const double climb = kUp.dot(moved.translation() - pose.translation());
      EXPECT_NEAR(climb, planar ? 0 : delta[2], 1e-12);
    }
  }
}

TEST(EdgeWithin, LeavesOnlyWhatTheVerticesCanChange) {
  PoseNoise noise(6);
  for (int i = 0; i < 20; ++i) {
    const PoseGraph::Edge measured = SomeEdge(noise);
    const Pose from = SomePose(noise), to = SomePose(noise);
    EXPECT_EQ(EdgeWithin(PoseFreedom::kFull, kUp, measured, from, to).information,
              measured.information);
    const PoseGraph::Edge upright = EdgeWithin(PoseFreedom::kUpright, kUp, measured, from, to);
    const Vec3 turn = (from.so3() * upright.T_from_to.so3() * to.so3().inverse()).Log();
    EXPECT_NEAR(turn.cross(kUp).norm(), 0, 1e-9) << "the error that is left is a yaw";
    EXPECT_EQ(upright.T_from_to.translation(), measured.T_from_to.translation());
    const PoseGraph::Edge planar = EdgeWithin(PoseFreedom::kPlanar, kUp, measured, from, to);
    EXPECT_NEAR(kUp.dot((from * planar.T_from_to).translation() - to.translation()), 0, 1e-9);
  }
}

TEST(EdgeWithin, KeepsTheYawOfUprightMeasurements) {
  const Pose from = Pose::Trans(1, 2, 3), to = Pose::Trans(2, 2, 3) * Pose::RotZ(0.4);
  PoseGraph::Edge edge;
  edge.T_from_to = Pose::Trans(1, 0.1, 0) * Pose::RotZ(-0.3);
  const PoseGraph::Edge upright = EdgeWithin(PoseFreedom::kPlanar, Vec3(0, 0, 1), edge, from, to);
  EXPECT_NEAR((upright.T_from_to.inverse() * edge.T_from_to).Log().norm(), 0, 1e-12);
}

}  // namespace
}  // namespace sslcd
