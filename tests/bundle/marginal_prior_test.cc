// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/marginal_prior.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

BaCamera CameraAt(int frame, double z) { return {frame, Pose({}, Vec3(0, 0, z))}; }

TEST(Marginalise, KeepsAnEarlierPriorWhateverItNames) {
  // Camera 10 goes; only odometry to 11 touches it. The prior names 12 and an object: with the
  // scale, as many blocks as odometry has.
  BaProblem problem;
  problem.cameras = {CameraAt(10, 0), CameraAt(11, 1), CameraAt(12, 2)};
  BaObject object;
  object.id = 5;
  object.pose.position = Vec3(2, 0, 3);
  problem.objects = {object};
  problem.odometry = {{0, 1, Pose({}, Vec3(0, 0, 1))}};
  problem.prior.frames = {12};
  problem.prior.object_ids = {5};
  problem.prior.cameras = {problem.cameras[2].T_world_cam};
  problem.prior.objects = {object.pose};
  problem.prior.J = Eigen::MatrixXd::Identity(11, 11);
  problem.prior.r0 = Eigen::VectorXd::Zero(11);

  const BaPrior prior = Marginalise(problem, {0}, {}, {});
  EXPECT_EQ(prior.frames, (std::vector<int>{11, 12}));
  EXPECT_EQ(prior.object_ids, std::vector<int>{5});
  const Eigen::MatrixXd H = prior.J.transpose() * prior.J;
  ASSERT_EQ(H.rows(), 6 + 6 + 4 + 1);
  EXPECT_TRUE(H.block(6, 6, 10, 10).isIdentity(1e-9)) << H;
}

}  // namespace
}  // namespace sslcd
