// SPDX-License-Identifier: BSD-3-Clause
#include "check/detection_units.h"

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(FrameNumbers, FromOneInStepsAndBeyond) {
  Sequence s = MakeDrive();
  EXPECT_EQ(IdOf(CheckFrameNumbers(s)), "ok");
  for (Row& row : s.rows) row.frame += 1;
  EXPECT_THAT(BeforeAndAfter(CheckFrameNumbers, s), ElementsAre("frame_numbers", "ok"));
  s = MakeDrive();
  for (Row& row : s.rows) row.frame *= 10;
  EXPECT_THAT(BeforeAndAfter(CheckFrameNumbers, s), ElementsAre("frame_numbers", "ok"));
  s = MakeDrive();
  for (Row& row : s.rows) row.frame += 5000;
  EXPECT_EQ(IdOf(CheckFrameNumbers(s)), "frame_numbers");
}

TEST(FrameNumbers, DetectionsOfALongerDriveAreSound) {
  Sequence s = MakeDrive();
  s.poses.resize(100);
  EXPECT_EQ(IdOf(CheckFrameNumbers(s)), "ok");
  s.rows.clear();
  EXPECT_EQ(IdOf(CheckFrameNumbers(s)), "not testable");
}

TEST(CuboidUnits, MillimetresAndCentimetres) {
  EXPECT_EQ(IdOf(CheckCuboidUnits(MakeDrive())), "ok");
  for (const double factor : {100., 1000.}) {
    Sequence s = MakeDrive();
    ChangeCuboids(s, [&](FileCuboid& c) {
      c = {factor * c.bottom, factor * c.h, factor * c.w, factor * c.l, c.rotation_y};
    });
    EXPECT_THAT(BeforeAndAfter(CheckCuboidUnits, s), ElementsAre("cuboid_units", "ok"));
    s = MakeDrive();
    ChangeCuboids(s, [&](FileCuboid& c) {
      c = {c.bottom, factor * c.h, factor * c.w, factor * c.l, c.rotation_y};
    });
    EXPECT_THAT(BeforeAndAfter(CheckCuboidUnits, s), ElementsAre("cuboid_units", "ok"));
    s.rows.resize(19);
    EXPECT_EQ(IdOf(CheckCuboidUnits(s)), "not testable");
  }
}

TEST(DetectionAxes, ALasersAxes) {
  Sequence s = MakeDrive();
  EXPECT_EQ(IdOf(CheckDetectionAxes(s)), "ok");
  ChangeCuboids(s, [](FileCuboid& c) {
    c.bottom = Vec3(c.bottom.z(), -c.bottom.x(), -c.bottom.y());
    c.rotation_y = WrapAngle(-c.rotation_y - M_PI / 2);
  });
  EXPECT_THAT(BeforeAndAfter(CheckDetectionAxes, s), ElementsAre("velodyne_frame", "ok"));
  s.rows.resize(49);
  EXPECT_EQ(IdOf(CheckDetectionAxes(s)), "not testable");
}

TEST(DetectionAxes, ACameraThatLooksDownIsSound) {
  Sequence s = MakeDrive();
  ChangeCuboids(s, [](FileCuboid& c) { c.bottom = Vec3(c.bottom.x(), c.bottom.z() - 12, 30); });
  EXPECT_EQ(IdOf(CheckDetectionAxes(s)), "ok");
}

}  // namespace
}  // namespace sslcd::check
