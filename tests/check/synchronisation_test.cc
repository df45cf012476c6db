// SPDX-License-Identifier: BSD-3-Clause
#include "check/synchronisation.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(Synchronisation, ShiftsAndOtherDrives) {
  EXPECT_EQ(IdOf(CheckSynchronisation(MakeDrive(900))), "ok");
  Sequence s = MakeDrive(900);
  std::rotate(s.poses.begin(), s.poses.begin() + 6, s.poses.end());
  s.poses.resize(894);
  EXPECT_THAT(BeforeAndAfter(CheckSynchronisation, s), ElementsAre("shifted_stamps", "ok"));
  s = MakeDrive(900);
  double heading = 0;
  Vec3 place = Vec3::Zero();
  for (std::size_t i = 0; i < s.poses.size(); ++i) {
    heading += i % 60 < 30 ? 0.04 : -0.04;
    place += 0.6 * Vec3(std::sin(heading), 0, std::cos(heading));
    s.poses[i] = Pose(lie::SO3<double>::RotY(heading), place);
  }
  EXPECT_EQ(IdOf(CheckSynchronisation(s)), "other_odometry");
  s.rows.resize(50);
  EXPECT_EQ(IdOf(CheckSynchronisation(s)), "not testable");
}

}  // namespace
}  // namespace sslcd::check
