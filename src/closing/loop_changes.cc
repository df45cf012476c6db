// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_changes.h"

#include <utility>

namespace sslcd {

std::vector<LoopClosure> LoopChanges::Take(const LoopLedger& ledger) {
  std::vector<LoopClosure> changed;
  if (ledger.revision() == revision_) return changed;
  revision_ = ledger.revision();
  for (const LoopAttempt& attempt : ledger.attempts()) {
    if (!attempt.counts()) continue;
    LoopClosure row = attempt.Measured();
    const auto [known, is_new] = known_.try_emplace(row.id, Known{row.decision, row.T_match_query});
    const bool is_same = known->second.decision == row.decision &&
                         known->second.T_match_query.matrix() == row.T_match_query.matrix();
    if (!is_new && is_same) continue;
    known->second = {row.decision, row.T_match_query};
    changed.push_back(std::move(row));
  }
  return changed;
}

}  // namespace sslcd
