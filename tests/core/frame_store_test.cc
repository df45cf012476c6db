// SPDX-License-Identifier: BSD-3-Clause
#include "core/frame_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

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

// The same, with what the odometry reports of the step to a frame.
FrameStore Reported(const std::vector<double>& x, const std::map<int, StepUncertainty>& reports,
                    double lost_path_m = 100) {
  FrameStore frames(lost_path_m);
  for (int i = 0; i < static_cast<int>(x.size()); ++i) {
    FrameRecord record;
    record.T_odom_cam = Pose::Trans(x[i], 0, 0);
    const auto report = reports.find(i);
    frames.Append(record, report == reports.end() ? std::nullopt : std::optional(report->second));
  }
  return frames;
}

const StepUncertainty kLost{true};

TEST(ReportedSteps, AddTheirVarianceInPlaceOfWhatAJumpSays) {
  const FrameStore frames =
      Reported({0, 1, 2, 3, 4, 5, 6, 7, 37, 38}, {{3, {false, 0.5, 0.1}}, {8, {false, 2, 0}}});
  const OdometryFailures small = FailuresBetween(frames, 2, 3),
                         jump = FailuresBetween(frames, 7, 8);
  EXPECT_EQ(small.translation_m2, 0.25);
  EXPECT_NEAR(small.rotation_rad2, 0.01, 1e-15);
  EXPECT_NEAR(jump.translation_m2, 4, 1e-12) << "not 30 m as well";
  EXPECT_NEAR(FailuresBetween(frames, 0, 9).translation_m2, 4.25, 1e-12);
  EXPECT_EQ(FailuresBetween(frames, 0, 9).lost, 0);
  EXPECT_EQ(frames.back().travelled, 38);
}

TEST(ReportedSteps, AJumpIsStillFoundAmongThem) {
  const std::vector<double> x{0, 4, 8, 12, 16, 20, 24, 28, 68};
  std::map<int, StepUncertainty> all;
  for (int i = 1; i < 8; ++i) all[i] = {false, 0.1, 0.01};
  EXPECT_NEAR(FailuresBetween(Reported(x, all), 7, 8).translation_m2, 40 * 40, 1e-9);
  EXPECT_EQ(FailuresBetween(Reported({0, 4, 8, 12, 16, 20, 24, 28, 32}, all), 7, 8).translation_m2,
            0)
      << "as long as the others";
}

TEST(ReportedSteps, ALostOneMayBeAnyStep) {
  const FrameStore frames = Reported({0, 1, 2, 2, 2, 3, 4}, {{3, kLost}, {4, kLost}});
  for (const int lost : {3, 4}) {
    EXPECT_TRUE(IsLost(frames, lost));
    EXPECT_GE(FailuresBetween(frames, lost - 1, lost).translation_m2, 1e6);
    EXPECT_GE(FailuresBetween(frames, lost - 1, lost).rotation_rad2, M_PI * M_PI - 1e-9);
  }
  for (const int known : {0, 1, 2, 5, 6}) EXPECT_FALSE(IsLost(frames, known));
  EXPECT_EQ(FailuresBetween(frames, 6, 0).lost, 2);
  EXPECT_FALSE(IsLost(Reported({0, 1}, {{0, kLost}}), 0)) << "there is no step to the first frame";
}

TEST(ReportedSteps, ALostStretchIsALongPathWithItsFramesInTheMiddle) {
  const FrameStore frames = Reported({0, 1, 2, 90, 5, 6, 7}, {{3, kLost}, {4, kLost}}, 100);
  EXPECT_EQ(frames[2].travelled, 2);
  EXPECT_EQ(frames[3].travelled, 52) << "whatever its step";
  EXPECT_EQ(frames[4].travelled, 52);
  EXPECT_EQ(frames[5].travelled, 103);
  EXPECT_EQ(frames[6].travelled, 104);
}

TEST(ReportedSteps, NoPathLeadsToALostFrame) {
  const FrameStore frames = Reported({0, 1, 2, 2, 2, 3, 4}, {{3, kLost}, {4, kLost}}, 100);
  for (const double path_m : {1.5, 2., 2.5, 30., 52.})
    EXPECT_EQ(frames.AtPath(path_m), 2) << path_m;
  for (const double path_m : {52.5, 80., 103.}) EXPECT_EQ(frames.AtPath(path_m), 5) << path_m;
  EXPECT_EQ(frames.AtPath(1000), 6);
  EXPECT_EQ(Reported({0, 1, 2, 2}, {{2, kLost}, {3, kLost}}).AtPath(1000), 1) << "lost at the end";
  EXPECT_EQ(frames.FirstFrom(30), 3) << "it is still the first one";
}

TEST(ReportedSteps, ALostOneIsNoLongStep) {
  const FrameStore frames = Reported({0, 1, 2, 3, 4, 5, 90, 91, 121}, {{6, kLost}});
  EXPECT_EQ(FailuresBetween(frames, 7, 8).translation_m2, 30 * 30) << "a jump by the others";
}

TEST(ReportedSteps, NoCameraIsWithinALostStretch) {
  const FrameStore frames = Reported({0, 1, 2, 2, 2, 3, 4}, {{3, kLost}, {4, kLost}}, 100);
  for (const double path_m : {0., 1.5, 2., 52., 103., 103.5, 1000.})
    EXPECT_FALSE(IsLostAt(frames, path_m)) << path_m;
  for (const double path_m : {2.5, 51.5, 52.5, 101.}) EXPECT_TRUE(IsLostAt(frames, path_m));
}

TEST(FrameStore, PartsBeginWhereOdometryWasLost) {
  EXPECT_TRUE(FrameStore().parts().empty());
  EXPECT_EQ(Line(3).parts(), std::vector<int>{0});
  const FrameStore frames = Reported({0, 1, 2, 2, 2, 3, 4}, {{3, kLost}, {4, kLost}}, 100);
  EXPECT_EQ(frames.parts(), (std::vector<int>{0, 3, 4}));
  EXPECT_EQ(frames.EndOfPart(0), 3);
  EXPECT_EQ(frames.EndOfPart(2), 7);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(frames[frames.parts()[k]].failures.lost, static_cast<int>(k));
}

}  // namespace
}  // namespace sslcd
