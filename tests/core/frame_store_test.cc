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

// Frames at these places along x, with these headings. [m, rad]
FrameStore Drive(const std::vector<double>& x, const std::vector<double>& yaw = {}) {
  FrameStore frames;
  for (std::size_t i = 0; i < x.size(); ++i) {
    FrameRecord record;
    record.T_odom_cam = Pose::Trans(x[i], 0, 0) * Pose::RotY(i < yaw.size() ? yaw[i] : 0.);
    frames.Append(record);
  }
  return frames;
}

TEST(OdometryFailures, AJumpIsAsUncertainAsItIsLong) {
  const FrameStore frames = Drive({0, 1, 2, 3, 4, 5, 6, 7, 37, 38, 39, 69});
  EXPECT_EQ(FailuresBetween(frames, 0, 7).translation_m2, 0);
  EXPECT_EQ(FailuresBetween(frames, 7, 8).translation_m2, 30 * 30);
  EXPECT_EQ(FailuresBetween(frames, 8, 10).translation_m2, 0);
  EXPECT_EQ(FailuresBetween(frames, 11, 0).translation_m2, 2 * 30 * 30) << "the second one, too";
  EXPECT_EQ(FailuresBetween(frames, 0, 11).rotation_rad2, 0);
}

TEST(OdometryFailures, DroppedFramesAQuickStartAndTheFirstStepsAreNone) {
  EXPECT_EQ(FailuresBetween(Drive({0, 1, 2, 3, 4, 5, 6, 13}), 0, 7).translation_m2, 0);
  EXPECT_EQ(FailuresBetween(Drive({0, 0, 0, 0, 0, 0, 0, 2.9}), 0, 7).translation_m2, 0);
  EXPECT_EQ(FailuresBetween(Drive({0, 1, 31}), 0, 2).translation_m2, 0);
}

TEST(OdometryFailures, ATurnInOneStep) {
  const std::vector<double> x{0, 1, 2, 3, 4, 5, 6, 7};
  const FrameStore turned = Drive(x, {0, 0, 0, 0, 0, 0, 0, 2});
  EXPECT_NEAR(FailuresBetween(turned, 0, 7).rotation_rad2, 4, 1e-9);
  EXPECT_EQ(FailuresBetween(turned, 0, 7).translation_m2, 0);
  EXPECT_EQ(FailuresBetween(Drive(x, {0, 0, 0, 0, 0, 0, 0, 1.4}), 0, 7).rotation_rad2, 0);
  EXPECT_EQ(FailuresBetween(Drive(x, {0, 1, 2, 3, 4, 5, 6, 8}), 0, 7).rotation_rad2, 0);
}

}  // namespace
}  // namespace sslcd
