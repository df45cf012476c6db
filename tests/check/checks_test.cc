// SPDX-License-Identifier: BSD-3-Clause
#include "check/checks.h"

#include <set>
#include <stdexcept>

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

TEST(Checks, SoundDataPassAndIdsAreUnique) {
  const CheckReport report = CheckSequence(MakeDrive());
  EXPECT_EQ(report.lines.size(), Checks().size());
  EXPECT_EQ(report.mistakes(), 0);
  std::set<std::string> ids;
  for (const Check& check : Checks())
    for (const MistakeInfo& mistake : check.mistakes) EXPECT_TRUE(ids.insert(mistake.id).second);
  EXPECT_THROW(MistakeOf("none"), std::out_of_range);
}

TEST(Checks, NothingAtAllIsNotTestable) {
  for (const CheckReport::Line& line : CheckSequence(Sequence()).lines)
    EXPECT_EQ(IdOf(line.outcome), "not testable") << line.check;
}

TEST(Checks, ALaterTestSeesTheCorrectedSequence) {
  Sequence s = MakeDrive();
  for (Pose& pose : s.poses) pose = pose.inverse();
  ChangeCuboids(s, [](FileCuboid& c) { c.bottom.y() -= 0.5 * c.h; });
  const CheckReport report = CheckSequence(s);
  EXPECT_EQ(report.mistakes(), 2);
  EXPECT_EQ(CheckSequence(report.repaired).mistakes(), 0);
}

}  // namespace
}  // namespace sslcd::check
