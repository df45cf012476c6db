// SPDX-License-Identifier: BSD-3-Clause
#include "check/ground_truth.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(GroundTruth, InverseUnitsAndAnotherDrive) {
  EXPECT_EQ(IdOf(CheckGroundTruth(MakeDrive())), "ok");
  Sequence s = MakeDrive();
  for (Pose& pose : s.groundtruth->poses) pose = pose.inverse();
  EXPECT_THAT(BeforeAndAfter(CheckGroundTruth, s), ElementsAre("groundtruth_inverse", "ok"));
  s = MakeDrive();
  for (Pose& pose : s.groundtruth->poses) pose = Pose(pose.so3(), 1000 * pose.translation());
  EXPECT_THAT(BeforeAndAfter(CheckGroundTruth, s), ElementsAre("groundtruth_units", "ok"));
  s = MakeDrive();
  std::reverse(s.groundtruth->poses.begin() + 100, s.groundtruth->poses.end());
  EXPECT_EQ(IdOf(CheckGroundTruth(s)), "groundtruth_other");
}

TEST(GroundTruth, PosesOfABody) {
  Eigen::Matrix3d R_cam_ros, R_cam_opengl = Vec3(1, -1, -1).asDiagonal();
  R_cam_ros << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  for (const Eigen::Matrix3d& R : {R_cam_ros, R_cam_opengl}) {
    Sequence s = MakeDrive();
    const Pose T_cam_body(lie::SO3<double>(Eigen::Quaterniond(R)), Vec3(0, 0, 0));
    for (Pose& pose : s.groundtruth->poses) pose = Pose::RotX(1) * pose * T_cam_body;
    EXPECT_THAT(BeforeAndAfter(CheckGroundTruth, s), ElementsAre("groundtruth_axes", "ok"));
  }
  Sequence s = MakeDrive();
  for (Pose& pose : s.groundtruth->poses) pose = Pose::Trans(Vec3(pose.translation()));
  EXPECT_EQ(IdOf(CheckGroundTruth(s)), "ok") << "positions without rotations are sound";
  s = MakeDrive();  // a camera that looks to the side
  for (Pose& pose : s.groundtruth->poses) pose = pose * Pose::RotY(M_PI / 2);
  EXPECT_EQ(IdOf(CheckGroundTruth(s)), "ok");
}

TEST(GroundTruth, AnotherFrameAndScaleAreSound) {
  Sequence s = MakeDrive();
  for (Pose& pose : s.groundtruth->poses) {
    pose = Pose::RotX(1) * Pose::Trans(3, 4, 5) * pose;
    pose = Pose(pose.so3(), 3 * pose.translation());
  }
  EXPECT_EQ(IdOf(CheckGroundTruth(s)), "ok");
  s.groundtruth.reset();
  EXPECT_EQ(IdOf(CheckGroundTruth(s)), "not testable");
}

}  // namespace
}  // namespace sslcd::check
