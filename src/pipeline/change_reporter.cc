// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/change_reporter.h"

#include <algorithm>
#include <utility>

namespace sslcd {

MapChanges ChangeReporter::Take(const MapState& result, bool is_copy, const LoopLedger& ledger) {
  MapChanges changes;
  const FrameStore& frames = result.frames;
  if (frames.empty()) return changes;
  changes.T_world_odom = frames.back().T_world_cam * frames.back().T_input_cam.inverse();
  const int first = is_copy || was_copy_ ? 0 : frames.FirstChangeSince(revision_);
  for (int i = first; i < frames.size(); ++i)
    changes.poses.push_back({frames[i].frame, frames[i].input_stamp, frames[i].T_world_cam});
  changes.loops = loops_.Take(ledger);
  for (LoopClosure& loop : changes.loops) {
    for (auto& [local, global] : loop.pairs) {
      local = result.map.Current(local).value_or(LandmarkId());
      global = result.map.Current(global).value_or(LandmarkId());
    }
    loop.pairs.erase(std::remove_if(loop.pairs.begin(), loop.pairs.end(),
                                    [](const auto& pair) {
                                      return pair.first == LandmarkId() ||
                                             pair.second == LandmarkId();
                                    }),
                     loop.pairs.end());
  }
  revision_ = frames.revision();
  was_copy_ = is_copy;
  return changes;
}

}  // namespace sslcd
