// SPDX-License-Identifier: BSD-3-Clause
// Loops between cameras on a straight path, a metre apart.
#pragma once

#include <vector>

#include "closing/loop_ledger.h"

namespace sslcd {

inline FrameStore Line(int count) {
  FrameStore frames;
  for (int i = 0; i < count; ++i) {
    FrameRecord record;
    record.frame = i;
    record.T_odom_cam = Pose::Trans(0, 0, i);
    frames.Append(record);
  }
  return frames;
}

inline FoundLoop Loop(int match, int query, LoopDecision decision, int track = -1,
                      bool confirmed = false) {
  FoundLoop found;
  found.loop.match = match;
  found.loop.query = query;
  found.loop.row.query_frame = query;
  found.loop.row.decision = decision;
  found.loop.row.reason = "as found";
  found.track = track;
  found.confirmed = confirmed;
  return found;
}

inline constexpr LoopDecision kOpen = LoopDecision::kAmbiguous, kAccepted = LoopDecision::kAccepted;

inline std::vector<int> IdsOf(const std::vector<LoopClosure>& rows) {
  std::vector<int> ids;
  for (const LoopClosure& row : rows) ids.push_back(row.id);
  return ids;
}

}  // namespace sslcd
