// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/loop_changes.h"
#include "map/map_state.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Remembers what a host has been told of a mapper's results. Copyable.
class ChangeReporter {
 public:
  /// What has changed since the call before. `result` is the optimised state, or a copy of it of
  /// which parts are the odometry (`is_copy`): all poses are new wherever one follows the other.
  MapChanges Take(const MapState& result, bool is_copy, const LoopLedger& ledger);

 private:
  LoopChanges loops_;
  FrameStore::Revision revision_ = 0;
  bool was_copy_ = false;
};

}  // namespace sslcd
