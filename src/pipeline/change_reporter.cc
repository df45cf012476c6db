// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/change_reporter.h"

#include <algorithm>
#include <utility>

namespace sslcd {

MapChanges ChangeReporter::Take(const MapState& state, const LoopLedger& ledger) {
  MapChanges changes;
  const FrameStore& frames = state.frames;
  if (frames.empty()) return changes;
  changes.T_world_odom = frames.back().T_world_cam * frames.back().T_input_cam.inverse();
  for (int i = frames.FirstChangeSince(revision_); i < frames.size(); ++i)
    changes.poses.push_back({frames[i].frame, frames[i].input_stamp, frames[i].T_world_cam});
  changes.loops = loops_.Take(ledger);
  for (LoopClosure& loop : changes.loops) {
    for (auto& [local, global] : loop.pairs) {
      local = state.map.Current(local).value_or(LandmarkId());
      global = state.map.Current(global).value_or(LandmarkId());
    }
    loop.pairs.erase(std::remove_if(loop.pairs.begin(), loop.pairs.end(),
                                    [](const auto& pair) {
                                      return pair.first == LandmarkId() ||
                                             pair.second == LandmarkId();
                                    }),
                     loop.pairs.end());
  }
  revision_ = frames.revision();
  return changes;
}

void ChangeReporter::TakeOver(const ChangeReporter& other, const LoopLedger& ledger,
                              int first_new) {
  loops_.TakeOver(other.loops_, ledger, first_new);
  revision_ = 0;
}

}  // namespace sslcd
