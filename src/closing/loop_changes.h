// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unordered_map>
#include <vector>

#include "closing/loop_ledger.h"

namespace sslcd {

/// Tells which loops a host does not know yet. Copyable.
class LoopChanges {
 public:
  /// The rows that are new, or whose decision or measurement has changed, since the call before.
  /// O(1) if nothing has happened in the ledger, otherwise O(attempts).
  std::vector<LoopClosure> Take(const LoopLedger& ledger);

 private:
  struct Known {
    LoopDecision decision;
    Pose T_match_query;
  };
  std::unordered_map<int, Known> known_;  // by id
  int revision_ = 0;                      // of the ledger
};

}  // namespace sslcd
