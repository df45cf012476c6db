// SPDX-License-Identifier: BSD-3-Clause
#include "check/pose_conventions.h"

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(PoseConvention, EachIsNamedAndCorrected) {
  EXPECT_EQ(IdOf(CheckPoseConvention(MakeDrive())), "ok");
  Sequence s = MakeDrive();
  for (Pose& pose : s.poses) pose = pose.inverse();
  EXPECT_THAT(BeforeAndAfter(CheckPoseConvention, s), ElementsAre("inverse_poses", "ok"));
  s = MakeDrive();
  for (Pose& pose : s.poses) pose = pose * Pose::RotX(M_PI);
  EXPECT_THAT(BeforeAndAfter(CheckPoseConvention, s), ElementsAre("opengl_axes", "ok"));
  s = MakeDrive();
  for (Pose& pose : s.poses)
    pose = Pose(pose.so3().inverse(),
                Vec3(-pose.translation().x(), pose.translation().y(), pose.translation().z()));
  EXPECT_THAT(BeforeAndAfter(CheckPoseConvention, s), ElementsAre("mirrored_poses", "ok"));
}

TEST(PoseConvention, CamerasThatLookElsewhereAreSound) {
  for (const double angle : {M_PI / 2, M_PI, -M_PI / 2}) {
    Sequence s = MakeDrive();
    const Pose turn = Pose::RotY(angle);
    for (Pose& pose : s.poses) pose = pose * turn;
    for (Row& row : s.rows)
      row.detection.T_cam_object = turn.inverse() * row.detection.T_cam_object;
    EXPECT_EQ(IdOf(CheckPoseConvention(s)), "ok") << angle;
  }
}

TEST(PoseConvention, TrafficThatOvertakesIsSound) {
  Sequence s = MakeDrive();  // all cars go twice as fast as the camera
  const Row car = s.rows.front();
  s.rows.clear();
  for (int i = 0; i < s.frames(); ++i) {
    s.poses[static_cast<std::size_t>(i)] = Pose::Trans(0, 0, 0.5 * i);
    for (int lane = -1; lane <= 1; ++lane) {
      Row row = car;
      row.frame = i;
      row.detection.T_cam_object = Pose(car.detection.T_cam_object.so3(),
                                        Vec3(5 * lane, 1, 5 + (i + 10 * lane + 10) % 30 * 0.5));
      s.rows.push_back(row);
    }
  }
  EXPECT_EQ(IdOf(CheckPoseConvention(s)), "ok");
}

TEST(PoseConvention, FewObjectsOrNoMotion) {
  Sequence s = MakeDrive();
  for (Pose& pose : s.poses) pose = Pose();
  EXPECT_EQ(IdOf(CheckPoseConvention(s)), "not testable");
  s = MakeDrive();
  s.rows.resize(20);
  EXPECT_EQ(IdOf(CheckPoseConvention(s)), "not testable");
  s.poses.clear();
  EXPECT_EQ(IdOf(CheckPoseConvention(s)), "not testable");
}

}  // namespace
}  // namespace sslcd::check
