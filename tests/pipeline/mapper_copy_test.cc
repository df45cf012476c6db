// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <utility>

#include "loop_drives.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {
namespace {

void ExpectSame(const Mapper& a, const Mapper& b) {
  const Trajectory one = a.CameraTrajectory(), other = b.CameraTrajectory();
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    ASSERT_EQ(one.poses[i].translation(), other.poses[i].translation()) << i;
  EXPECT_EQ(a.Objects().size(), b.Objects().size());
  const auto loops = a.LoopClosures(), others = b.LoopClosures();
  ASSERT_EQ(loops.size(), others.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    EXPECT_EQ(loops[i].decision, others[i].decision);
    EXPECT_EQ(loops[i].score, others[i].score);
  }
}

// A host refines a copy in a thread of its own, while the original goes on.
TEST(MapperCopy, HasAllStateAndGoesItsOwnWay) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Mapper mapper({}, drives.Context()), undisturbed({}, drives.Context());
  const std::size_t half = drives.frames.size() * 3 / 4;
  for (std::size_t i = 0; i < half; ++i) {
    mapper.AddFrame(drives.frames[i]);
    undisturbed.AddFrame(drives.frames[i]);
  }
  Mapper copy = mapper;
  copy.Refine();
  EXPECT_NE(copy.CameraTrajectory().poses.back().translation(),
            mapper.CameraTrajectory().poses.back().translation());
  ExpectSame(mapper, undisturbed);
  for (std::size_t i = half; i < drives.frames.size(); ++i) {
    mapper.AddFrame(drives.frames[i]);
    undisturbed.AddFrame(drives.frames[i]);
  }
  ExpectSame(mapper, undisturbed);

  Mapper late = std::move(mapper);
  copy = late;
  copy.Refine();
  late.Refine();
  ExpectSame(copy, late);
}

}  // namespace
}  // namespace sslcd
