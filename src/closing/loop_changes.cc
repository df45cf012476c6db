// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_changes.h"

namespace sslcd {

std::vector<LoopClosure> LoopChanges::Take(const LoopLedger& ledger) {
  std::vector<LoopClosure> changed;
  if (ledger.revision() == revision_) return changed;
  revision_ = ledger.revision();
  for (const LoopAttempt& attempt : ledger.attempts()) {
    if (!attempt.counts()) continue;
    const Known now{attempt.row().decision, attempt.T_match_query()};
    const auto [known, is_new] = known_.try_emplace(attempt.row().id, now);
    const bool is_same = known->second.decision == now.decision &&
                         known->second.T_match_query.matrix() == now.T_match_query.matrix();
    if (!is_new && is_same) continue;
    known->second = now;
    changed.push_back(attempt.Measured());
  }
  return changed;
}

}  // namespace sslcd
