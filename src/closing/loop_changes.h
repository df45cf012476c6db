// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <unordered_map>
#include <vector>

#include "closing/loop_ledger.h"

namespace sslcd {

/// Tells which loops a host does not know yet. Copyable.
class LoopChanges {
 public:
  /// The rows that are new, or whose decision or measurement has changed, since the call before,
  /// and early loops that have ended, as refused. O(1) if nothing has happened in the ledger,
  /// otherwise O(attempts).
  std::vector<LoopClosure> Take(const LoopLedger& ledger);

  /// From now on tells a host that knows what `other` has told of another ledger. Attempts from
  /// frame `first_new` on are all new, since their objects may be others. Accepted ones that
  /// `ledger` does not have are told once more, as refused.
  void TakeOver(const LoopChanges& other, const LoopLedger& ledger, int first_new);

 private:
  std::vector<LoopClosure> TakeEnded(const std::set<int>& there);

  std::unordered_map<int, LoopClosure> known_;  // by id, without pairs
  std::vector<LoopClosure> lost_;               // to be told
  int revision_ = 0;                            // of the ledger
};

}  // namespace sslcd
