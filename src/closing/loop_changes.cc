// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_changes.h"

#include <algorithm>
#include <set>
#include <utility>

namespace sslcd {
namespace {

LoopClosure WithoutPairs(LoopClosure row) {
  row.pairs.clear();
  return row;
}

bool IsSame(const LoopClosure& a, const LoopClosure& b) {
  return a.decision == b.decision && a.T_match_query.matrix() == b.T_match_query.matrix();
}

}  // namespace

std::vector<LoopClosure> LoopChanges::Take(const LoopLedger& ledger) {
  std::vector<LoopClosure> changed = std::exchange(lost_, {});
  if (ledger.revision() == revision_) return changed;
  revision_ = ledger.revision();
  for (const LoopAttempt& attempt : ledger.attempts()) {
    if (!attempt.counts()) continue;
    const LoopClosure now = attempt.Measured();
    const auto [known, is_new] = known_.try_emplace(now.id, WithoutPairs(now));
    if (!is_new && IsSame(known->second, now)) continue;
    known->second = WithoutPairs(now);
    changed.push_back(now);
  }
  return changed;
}

void LoopChanges::TakeOver(const LoopChanges& other, const LoopLedger& ledger, int first_new) {
  *this = other;
  revision_ = -1;
  std::set<int> there;
  for (const LoopAttempt& attempt : ledger.attempts())
    if (attempt.counts()) there.insert(attempt.row().id);
  for (auto known = known_.begin(); known != known_.end();) {
    LoopClosure& row = known->second;
    const bool is_lost = there.count(row.id) == 0;
    if (!is_lost && row.newest_frame < first_new) {
      ++known;
      continue;
    }
    if (is_lost && row.decision == LoopDecision::kAccepted) {
      row.decision = LoopDecision::kNone;
      row.reason = "not found again in the refined map";
      lost_.push_back(row);
    }
    known = known_.erase(known);
  }
  std::sort(lost_.begin(), lost_.end(),
            [](const LoopClosure& a, const LoopClosure& b) { return a.id < b.id; });
}

}  // namespace sslcd
