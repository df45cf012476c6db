// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/change_reporter.h"

#include <algorithm>
#include <utility>

#include "closing/parts.h"

namespace sslcd {

std::vector<MapPart> ListParts(const FrameStore& frames, const LoopLedger& ledger) {
  std::vector<MapPart> parts;
  for (const int first : frames.parts())
    parts.push_back({frames[first].frame, frames[first].sequence, 0});
  if (parts.size() < 2) return parts;
  const std::vector<int> joined = JoinParts(frames, ledger.AcceptedEdges());
  for (std::size_t k = 0; k < parts.size(); ++k) parts[k].joined_with = joined[k];
  return parts;
}

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
  std::vector<MapPart> parts = ListParts(frames, ledger);
  if (!(parts == parts_)) changes.parts = parts_ = std::move(parts);
  return changes;
}

void ChangeReporter::TakeOver(const ChangeReporter& other, const LoopLedger& ledger,
                              int first_new) {
  loops_.TakeOver(other.loops_, ledger, first_new);
  parts_ = other.parts_;
  revision_ = 0;
}

}  // namespace sslcd
