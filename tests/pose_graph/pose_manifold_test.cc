// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/pose_manifold.h"

#include <ceres/manifold_test_utils.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sslcd/core/pose.h"

namespace sslcd {
namespace {

TEST(PoseManifold, Invariants) {
  for (const double angle : {0., 1e-9, 0.3, 2., 3.}) {
    Vec6 a, b, d;
    a << 1, 2, 3, angle, 0.1, -0.2;
    b << -1, 0.5, 2, 0.4, angle / 2, 0.3;
    d << 0.1, -0.2, 0.3, 0.05, 0.1, -0.02;
    const Eigen::VectorXd x = Eigen::Map<const Eigen::Matrix<double, 7, 1>>(Pose::Exp(a).data());
    const Eigen::VectorXd y = Eigen::Map<const Eigen::Matrix<double, 7, 1>>(Pose::Exp(b).data());
    const Eigen::VectorXd delta = d;
    const PoseManifold manifold;
    EXPECT_THAT(manifold, ceres::XPlusZeroIsXAt(x, 1e-9));
    EXPECT_THAT(manifold, ceres::XMinusXIsZeroAt(x, 1e-9));
    EXPECT_THAT(manifold, ceres::MinusPlusIsIdentityAt(x, delta, 1e-9));
    EXPECT_THAT(manifold, ceres::HasCorrectPlusJacobianAt(x, 1e-9));
    EXPECT_THAT(manifold, ceres::HasCorrectMinusJacobianAt(x, 1e-9));
    EXPECT_THAT(manifold, ceres::MinusPlusJacobianIsIdentityAt(x, 1e-9));
    EXPECT_THAT(manifold, ceres::PlusMinusIsIdentityAt(x, y, 1e-9));
  }
}

TEST(PoseManifold,
     TurnsByTheWholeAngle) {  // Ceres' EigenQuaternionManifold would turn twice as far
  const Pose x;
  const double delta[6] = {0, 0, 0, 0.1, 0, 0};
  double moved[7];
  PoseManifold().Plus(x.data(), delta, moved);
  EXPECT_NEAR(2 * std::asin(moved[0]), 0.1, 1e-12);
}

}  // namespace
}  // namespace sslcd
