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
  return a.decision == b.decision && a.early == b.early &&
         a.T_match_query.matrix() == b.T_match_query.matrix();
}

void SortById(std::vector<LoopClosure>& rows) {
  std::sort(rows.begin(), rows.end(),
            [](const LoopClosure& a, const LoopClosure& b) { return a.id < b.id; });
}

std::set<int> IdsOf(const std::vector<LoopClosure>& rows) {
  std::set<int> ids;
  for (const LoopClosure& row : rows) ids.insert(row.id);
  return ids;
}

}  // namespace

std::vector<LoopClosure> LoopChanges::Take(const LoopLedger& ledger) {
  std::vector<LoopClosure> changed = std::exchange(lost_, {});
  if (ledger.revision() == revision_) return changed;
  revision_ = ledger.revision();
  const std::vector<LoopClosure> rows = ledger.Rows();
  for (const LoopClosure& now : rows) {
    const auto [known, is_new] = known_.try_emplace(now.id, WithoutPairs(now));
    if (!is_new && IsSame(known->second, now)) continue;
    known->second = WithoutPairs(now);
    changed.push_back(now);
  }
  for (LoopClosure& ended : TakeEnded(IdsOf(rows))) changed.push_back(std::move(ended));
  return changed;
}

// The early loops that are not `there` any more, as refused.
std::vector<LoopClosure> LoopChanges::TakeEnded(const std::set<int>& there) {
  std::vector<LoopClosure> ended;
  for (auto known = known_.begin(); known != known_.end();) {
    LoopClosure& row = known->second;
    if (!row.early || there.count(row.id) > 0) {
      ++known;
      continue;
    }
    row.decision = LoopDecision::kNone;
    row.reason = "an early loop has ended";
    ended.push_back(std::move(row));
    known = known_.erase(known);
  }
  SortById(ended);
  return ended;
}

void LoopChanges::TakeOver(const LoopChanges& other, const LoopLedger& ledger, int first_new) {
  *this = other;
  revision_ = -1;
  const std::set<int> there = IdsOf(ledger.Rows());
  for (auto known = known_.begin(); known != known_.end();) {
    LoopClosure& row = known->second;
    const bool is_lost = there.count(row.id) == 0;
    // an early one may end before it is told again
    if (!is_lost && (row.early || row.newest_frame < first_new)) {
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
  SortById(lost_);
}

}  // namespace sslcd
