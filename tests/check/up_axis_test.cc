// SPDX-License-Identifier: BSD-3-Clause
#include "check/up_axis.h"

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(UpAxis, AnotherAxisAndTheOppositeOne) {
  EXPECT_EQ(IdOf(CheckUpAxis(MakeDrive())), "ok");
  for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0)}) {
    Sequence s = MakeDrive();
    s.up_axis = up;
    EXPECT_THAT(BeforeAndAfter(CheckUpAxis, s), ElementsAre("up_axis", "ok"));
  }
}

TEST(UpAxis, SlopesAndCamerasThatLookDownAreSound) {
  Sequence s = MakeDrive();
  s.up_axis = Vec3(0, -0.9, 0.4).normalized();
  EXPECT_EQ(IdOf(CheckUpAxis(s)), "ok");
  s = MakeDrive();
  const Pose down = Pose::RotX(-M_PI / 2);
  for (Pose& pose : s.poses) pose = pose * down;
  for (Row& row : s.rows) row.detection.T_cam_object = down.inverse() * row.detection.T_cam_object;
  EXPECT_EQ(IdOf(CheckUpAxis(s)), "ok");
  s.rows.resize(40);
  EXPECT_EQ(IdOf(CheckUpAxis(s)), "not testable");
}

}  // namespace
}  // namespace sslcd::check
