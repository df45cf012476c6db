// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/merge_changes.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sslcd {

void MergeChanges(MapChanges newer, MapChanges& changes) {
  if (!newer.poses.empty()) {
    changes.T_world_odom = newer.T_world_odom;
    changes.scale = newer.scale;
    const auto first =
        std::lower_bound(changes.poses.begin(), changes.poses.end(), newer.poses.front().frame,
                         [](const FramePose& pose, int frame) { return pose.frame < frame; });
    changes.poses.erase(first, changes.poses.end());
    std::move(newer.poses.begin(), newer.poses.end(), std::back_inserter(changes.poses));
  }
  if (!newer.parts.empty()) changes.parts = std::move(newer.parts);
  for (LoopClosure& loop : newer.loops) {
    const auto known = std::find_if(changes.loops.begin(), changes.loops.end(),
                                    [&](const LoopClosure& old) { return old.id == loop.id; });
    if (known == changes.loops.end())
      changes.loops.push_back(std::move(loop));
    else
      *known = std::move(loop);
  }
}

}  // namespace sslcd
