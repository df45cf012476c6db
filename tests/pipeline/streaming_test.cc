// SPDX-License-Identifier: BSD-3-Clause
// What a mapper tells a host while it runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "host_copy.h"
#include "loop_drives.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {
namespace {

TEST(Streaming, ChangesAloneKeepAHostsCopyUpToDate) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Mapper mapper({}, drives.Context());
  HostCopy copy;
  std::size_t told = 0;
  for (const Frame& frame : drives.frames) {
    const FrameReport report = mapper.AddFrame(frame);
    copy.Apply(report.changes);
    told += report.changes.poses.size();
    EXPECT_LT((report.changes.T_world_odom * frame.T_odom_cam * report.T_world_cam.inverse())
                  .Log()
                  .norm(),
              1e-9);
    EXPECT_EQ(report.changes.scale, mapper.scale());
  }
  EXPECT_NE(mapper.scale(), 1);
  copy.ExpectIsOf(mapper);
  EXPECT_GT(Accepted(copy.loops), 0);
  EXPECT_LT(told, drives.frames.size() * drives.frames.size() / 10) << "only what has changed";
  EXPECT_TRUE(mapper.TakeChanges().loops.empty()) << "told already";
  const int loops = Accepted(copy.loops);

  mapper.Refine();
  copy.Apply(mapper.TakeChanges());
  copy.ExpectIsOf(mapper);
  EXPECT_GE(loops, 0.95 * Accepted(copy.loops)) << "a host has them before, too";
  for (const auto& [id, loop] : copy.loops) EXPECT_FALSE(loop.early) << id;
  Frame next = drives.frames.back();
  next.index += 1;
  next.stamp += 1;
  copy.Apply(mapper.AddFrame(next).changes);
  copy.ExpectIsOf(mapper);
}

TEST(Streaming, LandmarksOfLoopsAreThoseOfTheMap) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Mapper mapper({}, drives.Context());
  std::vector<LoopClosure> accepted;
  for (const Frame& frame : drives.frames) {
    for (LoopClosure& loop : mapper.AddFrame(frame).changes.loops) {
      std::map<int, MapObject> map;
      for (const MapObject& object : mapper.Objects()) map[object.id.value] = object;
      for (const auto& [local, global] : loop.pairs) {
        EXPECT_EQ(map.count(local.value), 1u);
        EXPECT_EQ(map.count(global.value), 1u);
      }
      if (loop.decision == LoopDecision::kAccepted) accepted.push_back(std::move(loop));
    }
  }
  ASSERT_FALSE(accepted.empty());
  mapper.Refine();
  int one = 0, all = 0;
  for (const LoopClosure& loop : accepted) {
    for (const auto& [local, global] : loop.pairs) {
      const auto a = mapper.Current(local), b = mapper.Current(global);
      one += a && a == b;
      ++all;
    }
  }
  EXPECT_GT(one, 0.8 * all) << "matched objects are one landmark in the end";
  EXPECT_FALSE(mapper.Current({1000000}).has_value());
}

// The second lap is a sequence of its own: another origin, another heading, stamps from 0.
TEST(Streaming, LoopsJoinSequences) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  std::vector<Frame> frames = drives.frames;
  const std::size_t second = frames.size() / 2 + 40;
  const Pose T_other_odom =
      Pose(lie::SO3<double>::RotY(2), Vec3(-300, 0, 50)) * frames[second].T_odom_cam.inverse();
  const double start = frames[second].stamp;
  Mapper mapper({}, drives.Context());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i >= second) {
      frames[i].T_odom_cam = T_other_odom * frames[i].T_odom_cam;
      frames[i].stamp -= start;
    }
    if (i == second) {
      EXPECT_THROW(mapper.AddFrame(frames[i]), Error) << "the stamp goes back";
      mapper.StartSequence();
    }
    mapper.AddFrame(frames[i]);
  }
  mapper.Refine();
  int joining = 0;
  for (const LoopClosure& loop : mapper.LoopClosures()) {
    if (loop.decision != LoopDecision::kAccepted) continue;
    const Pose T_true = drives.world.truth.poses[loop.match_frame].inverse() *
                        drives.world.truth.poses[loop.query_frame];
    EXPECT_LT((T_true.inverse() * loop.T_match_query).translation().norm(), 2);
    joining +=
        loop.match_frame < static_cast<int>(second) && loop.query_frame >= static_cast<int>(second);
  }
  EXPECT_GT(joining, 5);
  const Trajectory trajectory = mapper.CameraTrajectory();
  EXPECT_EQ(trajectory.stamps[second], 0);
  const Pose T_true = drives.world.truth.poses[0].inverse() * drives.world.truth.poses.back();
  const Pose T = trajectory.poses[0].inverse() * trajectory.poses.back();
  EXPECT_LT((T_true.translation() - T.translation()).norm(), 3);
}

TEST(Streaming, TheSummaryTellsWhyThereAreNoLoops) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  MapperContext context = drives.Context();
  Mapper good({}, context);
  context.gravity = GravityFrame::FromUp({0, 0, 1});  // the camera's y axis points down
  Mapper lying({}, context);
  for (const Frame& frame : drives.frames) {
    good.AddFrame(frame);
    lying.AddFrame(frame);
  }
  const LoopSearchSummary summary = good.SummariseLoopSearch();
  EXPECT_GT(summary.searches, 50);
  EXPECT_GT(summary.accepted, 0);
  EXPECT_GT(summary.without_candidate, 0) << "in the first lap";
  int refused = 0;
  for (const auto& [reason, count] : summary.refused) refused += count;
  EXPECT_EQ(summary.accepted + summary.without_candidate + refused, summary.searches);
  EXPECT_TRUE(summary.up_axis_is_plausible);
  EXPECT_FALSE(lying.SummariseLoopSearch().up_axis_is_plausible);
  EXPECT_NE(lying.SummariseLoopSearch().Text().find("up axis"), std::string::npos);
}

TEST(LoopSearchSummary, NamesTheMostFrequentReasonFirst) {
  LoopSearchSummary summary;
  summary.searches = 38;
  summary.without_candidate = 10;
  summary.refused = {{"another pose fits nearly as well", 26}, {"heading too uncertain", 2}};
  EXPECT_EQ(summary.Text(),
            "38 searches, 0 loops accepted; 26: another pose fits nearly as well; 10: too few "
            "objects in sight, or in the map, agree; 2: heading too uncertain");
}

}  // namespace
}  // namespace sslcd
