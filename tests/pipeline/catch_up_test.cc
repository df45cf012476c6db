// SPDX-License-Identifier: BSD-3-Clause
// A copy is refined while the original goes on, and then replaces it.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "host_copy.h"
#include "loop_drives.h"
#include "same_mappers.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {
namespace {

struct Replaced {
  Mapper mapper;       // the copy that has caught up
  HostCopy host;       // told by the original, then by the copy
  HostCopy before;     // told by the original
  MapChanges changes;  // what the copy has told
  Mapper in_turn;      // refined between the same two frames
  int first_new = 0;   // frame after the copy was taken
  Mapper original;
};

// Refines a copy of a mapper that has got a share of the frames. `starts_after`: number of frames
// between the copy and the start of a sequence; -1: none starts.
Replaced Replace(const Drives& drives, int starts_after = -1, double share = 0.75,
                 Refinement when = Refinement::kOnTheWay) {
  Mapper mapper({}, drives.Context());
  HostCopy host;
  const auto half = static_cast<std::size_t>(share * static_cast<double>(drives.frames.size()));
  for (std::size_t i = 0; i < half; ++i) host.Apply(mapper.AddFrame(drives.frames[i]).changes);
  Mapper copy = mapper, in_turn = mapper;
  in_turn.Refine(when);
  std::vector<AddedFrame> since;
  for (std::size_t i = half; i < drives.frames.size(); ++i) {
    since.push_back({drives.frames[i], static_cast<int>(i - half) == starts_after});
    if (since.back().starts_sequence) {
      mapper.StartSequence();
      in_turn.StartSequence();
    }
    host.Apply(mapper.AddFrame(drives.frames[i]).changes);
    in_turn.AddFrame(drives.frames[i]);
  }
  const HostCopy before = host;
  copy.Refine(when);
  copy.CatchUp(mapper, since);
  const MapChanges changes = copy.TakeChanges();
  host.Apply(changes);
  return {copy, host, before, changes, in_turn, drives.frames[half].index, mapper};
}

TEST(CatchUp, IsARefinementBetweenTwoFrames) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  const Replaced replaced = Replace(drives);
  ExpectSame(replaced.mapper, replaced.in_turn);
  EXPECT_NE(replaced.mapper.CameraTrajectory().poses.back().translation(),
            replaced.original.CameraTrajectory().poses.back().translation());
  const Replaced two = Replace(drives, 20);
  ExpectSame(two.mapper, two.in_turn);
}

// Whatever the refinement has found by itself.
TEST(CatchUp, TellsAHostWhatDiffersFromTheOriginal) {
  for (const int seed : {1, 2}) {
    for (const Refinement when : {Refinement::kOnTheWay, Refinement::kAtEnd}) {
      SCOPED_TRACE(seed);
      const Drives drives = TwoLaps(SecondLap::kSame, 0.5, seed);
      const Replaced replaced = Replace(drives, -1, 0.6 + 0.1 * seed, when);
      const Trajectory trajectory = replaced.mapper.CameraTrajectory();
      ASSERT_EQ(replaced.host.poses.size(), trajectory.size());
      std::size_t i = 0;
      for (const auto& [frame, pose] : replaced.host.poses)
        ASSERT_EQ(pose.T_world_cam.matrix(), trajectory.poses[i++].matrix()) << "frame " << frame;
      std::map<int, LoopClosure> rows;
      int accepted = 0;
      for (const LoopClosure& row : replaced.mapper.LoopClosures()) {
        EXPECT_TRUE(rows.emplace(row.id, row).second) << "two attempts with the id " << row.id;
        accepted += row.decision == LoopDecision::kAccepted;
      }
      EXPECT_EQ(Accepted(replaced.host.loops), accepted);
      EXPECT_GT(accepted, 10);
      for (const auto& [id, row] : replaced.host.loops) {
        if (row.decision != LoopDecision::kAccepted) continue;
        ASSERT_EQ(rows.count(id), 1u) << id;
        EXPECT_EQ(rows.at(id).T_match_query.matrix(), row.T_match_query.matrix()) << id;
      }
    }
  }
}

// An id means the same attempt, and the same landmark, before and after.
TEST(CatchUp, ReusesNoId) {
  const Replaced replaced = Replace(TwoLaps(SecondLap::kOpposite, 0.5, 1));
  int again = 0;
  for (const auto& [id, row] : replaced.host.loops) {
    const auto old = replaced.before.loops.find(id);
    if (old == replaced.before.loops.end()) continue;
    EXPECT_EQ(old->second.query_frame, row.query_frame) << id;
    EXPECT_EQ(old->second.match_frame, row.match_frame) << id;
    again += row.newest_frame >= replaced.first_new;
  }
  EXPECT_GT(again, 3) << "attempts that both have made";
  std::map<int, std::set<std::pair<int, int>>> sightings;
  for (const MapObject& object : replaced.original.Objects())
    for (const Observation& seen : object.observations)
      sightings[object.id.value].insert({seen.frame, seen.detection_row});
  int kept = 0;
  for (const MapObject& object : replaced.mapper.Objects()) {
    const auto old = sightings.find(object.id.value);
    if (old == sightings.end()) continue;
    ++kept;
    int common = 0;
    for (const Observation& seen : object.observations)
      common += old->second.count({seen.frame, seen.detection_row}) > 0;
    EXPECT_GT(common, 0) << object.id.value;
  }
  EXPECT_GT(kept, 20);
}

}  // namespace
}  // namespace sslcd
