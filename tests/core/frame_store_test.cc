// SPDX-License-Identifier: BSD-3-Clause
#include "core/frame_store.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

// Frames a metre apart.
FrameStore Line(int count) {
  FrameStore frames;
  for (int i = 0; i < count; ++i) {
    FrameRecord record;
    record.T_odom_cam = record.T_world_cam = Pose::Trans(0, 0, i);
    frames.Append(record);
  }
  return frames;
}

TEST(FrameStore, PathIsThatOfTheOdometry) {
  FrameStore frames = Line(3);
  FrameRecord aside;
  aside.T_odom_cam = Pose::Trans(3, 0, 6);  // 5 m from the last one
  aside.travelled = 1000;                   // is filled in
  frames.Append(aside);
  EXPECT_EQ(frames[2].travelled, 2);
  EXPECT_NEAR(frames[3].travelled, 7, 1e-12);
}

TEST(FrameStore, FindsFramesByPath) {
  const FrameStore frames = Line(4);
  EXPECT_EQ(frames.FirstFrom(-1), 0);
  EXPECT_EQ(frames.FirstFrom(1), 1);
  EXPECT_EQ(frames.FirstFrom(1.1), 2);
  EXPECT_EQ(frames.FirstFrom(9), 4) << "past the end";
  EXPECT_EQ(frames.AtPath(9), 3) << "the last one";
  EXPECT_EQ(FrameStore().FirstFrom(0), 0);
}

TEST(FrameStore, TellsEachReaderWhatHasChangedSinceItsRevision) {
  FrameStore frames = Line(10);
  EXPECT_EQ(frames.FirstChangeSince(0), 0) << "all are new";
  const FrameStore::Revision first = frames.revision();
  EXPECT_EQ(frames.FirstChangeSince(first), 10) << "none";
  frames.SetPose(7, {});
  const FrameStore::Revision second = frames.revision();
  frames.SetPose(8, {});
  EXPECT_EQ(frames.FirstChangeSince(first), 7);
  EXPECT_EQ(frames.FirstChangeSince(second), 8);
  frames.SetPose(3, {});
  EXPECT_EQ(frames.FirstChangeSince(first), 3);
  EXPECT_EQ(frames.FirstChangeSince(second), 3);
  const FrameStore::Revision third = frames.revision();
  frames.Append({});
  EXPECT_EQ(frames.FirstChangeSince(third), 10) << "the new one";
  EXPECT_EQ(frames.FirstChangeSince(second), 3);
}

TEST(FrameStore, ACopyGoesItsOwnWay) {
  FrameStore frames = Line(3);
  const FrameStore::Revision before = frames.revision();
  FrameStore copy = frames;
  copy.SetPose(1, Pose::Trans(5, 0, 0));
  EXPECT_EQ(frames.FirstChangeSince(before), 3);
  EXPECT_EQ(copy.FirstChangeSince(before), 1);
  EXPECT_EQ(frames[1].T_world_cam.translation().x(), 0);
}

TEST(FrameStore, MatchesAreNoChangeOfPose) {
  FrameStore frames = Line(3);
  const FrameStore::Revision before = frames.revision();
  frames.SetMatched(1, {{4}});
  EXPECT_EQ(frames[1].matched[0].value, 4);
  EXPECT_EQ(frames.FirstChangeSince(before), 3);
}

}  // namespace
}  // namespace sslcd
