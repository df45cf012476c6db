// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/loop_changes.h"
#include "map/map_state.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Mapper::Parts.
std::vector<MapPart> ListParts(const FrameStore& frames, const LoopLedger& ledger);

/// Remembers what a host has been told of a mapper's results. Copyable.
class ChangeReporter {
 public:
  /// What has changed since the call before.
  MapChanges Take(const MapState& state, const LoopLedger& ledger);

  /// From now on tells a host of a state that knows what `other` has told of another one: all
  /// poses, and the loops by LoopChanges::TakeOver.
  void TakeOver(const ChangeReporter& other, const LoopLedger& ledger, int first_new);

 private:
  LoopChanges loops_;
  std::vector<MapPart> parts_;
  FrameStore::Revision revision_ = 0;
};

}  // namespace sslcd
