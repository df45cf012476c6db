// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "sslcd/pipeline/mapper.h"

namespace sslcd {

// A host's copy of the results, which it keeps by the changes alone.
struct HostCopy {
  std::map<int, FramePose> poses;
  std::map<int, LoopClosure> loops;
  std::vector<MapPart> parts;

  void Apply(const MapChanges& changes) {
    for (const FramePose& pose : changes.poses) poses[pose.frame] = pose;
    for (const LoopClosure& loop : changes.loops) {
      loops[loop.id] = loop;
      if (loop.early && loop.decision != LoopDecision::kAccepted) loops.erase(loop.id);
    }
    if (!changes.parts.empty()) parts = changes.parts;
  }

  void ExpectIsOf(const Mapper& mapper) const {
    const Trajectory trajectory = mapper.CameraTrajectory();
    ASSERT_EQ(trajectory.size(), poses.size());
    std::size_t i = 0;
    for (const auto& [frame, pose] : poses) {
      ASSERT_EQ(pose.T_world_cam.matrix(), trajectory.poses[i].matrix()) << "frame " << frame;
      ASSERT_EQ(pose.stamp, trajectory.stamps[i++]);
    }
    ASSERT_EQ(parts, mapper.Parts());
    const std::vector<LoopClosure> rows = mapper.LoopClosures();
    ASSERT_EQ(rows.size(), loops.size());
    for (const LoopClosure& row : rows) {
      ASSERT_EQ(loops.at(row.id).decision, row.decision) << row.id;
      ASSERT_EQ(loops.at(row.id).T_match_query.matrix(), row.T_match_query.matrix()) << row.id;
    }
  }
};

inline int Accepted(const std::map<int, LoopClosure>& loops) {
  return static_cast<int>(std::count_if(loops.begin(), loops.end(), [](const auto& loop) {
    return loop.second.decision == LoopDecision::kAccepted;
  }));
}

}  // namespace sslcd
