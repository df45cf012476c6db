// SPDX-License-Identifier: BSD-3-Clause
#include "check/stamps.h"

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(StampUnits, NanoMicroMilli) {
  EXPECT_EQ(IdOf(CheckStampUnits(MakeDrive())), "ok");
  for (const double factor : {1e9, 1e6, 1e3}) {
    Sequence s = MakeDrive();
    for (double& stamp : s.stamps) stamp *= factor;
    EXPECT_THAT(BeforeAndAfter(CheckStampUnits, s), ElementsAre("stamp_units", "ok"));
  }
}

TEST(StampUnits, ACameraThatStandsOrWaitsIsSound) {
  Sequence s = MakeDrive();
  for (double& stamp : s.stamps) stamp *= 100;  // a frame every 20 s
  EXPECT_EQ(IdOf(CheckStampUnits(s)), "ok");
  for (Pose& pose : s.poses) pose = Pose();
  EXPECT_EQ(IdOf(CheckStampUnits(s)), "ok");
  s.poses.resize(2);
  EXPECT_EQ(IdOf(CheckStampUnits(s)), "not testable");
}

TEST(OdometryUnits, ByObjectsAndBySpeed) {
  EXPECT_EQ(IdOf(CheckOdometryUnits(MakeDrive())), "ok");
  for (const double factor : {0.01, 100., 1000.}) {
    Sequence s = MakeDrive();
    for (Pose& pose : s.poses) pose = Pose(pose.so3(), factor * pose.translation());
    EXPECT_THAT(BeforeAndAfter(CheckOdometryUnits, s), ElementsAre("odometry_units", "ok"));
    s.rows.clear();
    EXPECT_EQ(IdOf(CheckOdometryUnits(s)), factor < 1 ? "ok" : "odometry_units");
  }
}

TEST(OdometryUnits, ADriveOfUnknownScaleIsSound) {
  for (const double factor : {0.3, 0.7, 1.5, 4.}) {
    Sequence s = MakeDrive();
    for (Pose& pose : s.poses) pose = Pose(pose.so3(), factor * pose.translation());
    EXPECT_EQ(IdOf(CheckOdometryUnits(s)), "ok") << factor;
  }
}

}  // namespace
}  // namespace sslcd::check
