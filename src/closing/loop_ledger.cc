// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_ledger.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sslcd {
namespace {

void AddToGraph(LoopAttempt& attempt) {
  attempt.in_graph = true;
  attempt.row().decision = LoopDecision::kAccepted;
}

}  // namespace

const Pose& LoopAttempt::T_match_query() const {
  return remeasured && accepted() ? remeasured->T_match_query : row().T_match_query;
}

LoopClosure LoopAttempt::Measured() const {
  LoopClosure measured = row();
  if (!remeasured || !accepted()) return measured;
  measured.T_match_query = remeasured->T_match_query;
  measured.covariance = remeasured->covariance;
  measured.viewpoint_change_rad = remeasured->viewpoint_change_rad;
  measured.by_views = remeasured->by_views;
  return measured;
}

bool LoopLedger::Add(const FoundLoop& found, const SearchWindow& window, int newest_frame) {
  const Key key = KeyOf(found.loop, newest_frame);
  const bool known =
      std::any_of(attempts_.begin(), attempts_.end(), [&](const LoopAttempt& attempt) {
        return KeyOf(attempt.found.loop, attempt.row().newest_frame) == key;
      });
  if (known) return false;
  LoopAttempt& attempt = attempts_.emplace_back();
  attempt.found = found;
  const auto reserved = reserved_.find(key);
  attempt.row().id = reserved != reserved_.end() ? reserved->second : next_id_++;
  attempt.row().newest_frame = newest_frame;
  ++revision_;
  attempt.window = window;
  return true;
}

void LoopLedger::ReserveIds(const LoopLedger& other) {
  std::set<int> used;
  for (const LoopAttempt& attempt : other.attempts_) {
    reserved_[KeyOf(attempt.found.loop, attempt.row().newest_frame)] = attempt.row().id;
    used.insert(attempt.row().id);
  }
  next_id_ = std::max(next_id_, other.next_id_);
  for (LoopAttempt& attempt : attempts_) {
    const auto reserved = reserved_.find(KeyOf(attempt.found.loop, attempt.row().newest_frame));
    if (reserved != reserved_.end())
      attempt.row().id = reserved->second;
    else if (used.count(attempt.row().id) > 0)
      attempt.row().id = next_id_++;
  }
}

void LoopLedger::AcceptNewest() {
  ++revision_;
  LoopAttempt& newest = attempts_.back();
  const std::string settled = "settled by frame " + std::to_string(newest.row().query_frame);
  for (LoopAttempt& earlier : attempts_) {
    const FoundLoop& found = earlier.found;
    if (&earlier == &newest || found.track < 0 || found.track != newest.found.track) continue;
    if (earlier.window.second != newest.window.second) continue;  // tracks of another finder
    if (!found.confirmed || earlier.in_graph) continue;
    earlier.row().reason = settled;
    AddToGraph(earlier);
  }
  AddToGraph(newest);
}

void LoopLedger::DropUnacceptedOfSecond() {
  ++revision_;
  attempts_.erase(std::remove_if(attempts_.begin(), attempts_.end(),
                                 [](const LoopAttempt& attempt) { return !attempt.counts(); }),
                  attempts_.end());
}

bool LoopLedger::FusedByRefused() const {
  return std::any_of(attempts_.begin(), attempts_.end(), [](const LoopAttempt& attempt) {
    return attempt.fused && !attempt.accepted();
  });
}

void LoopLedger::ForgetFusions() {
  for (LoopAttempt& attempt : attempts_) attempt.fused = false;
}

void LoopLedger::MarkRefined() {
  for (LoopAttempt& attempt : attempts_) attempt.refined = attempt.accepted();
}

bool LoopLedger::RefinedByRefused() const {
  return std::any_of(attempts_.begin(), attempts_.end(), [](const LoopAttempt& attempt) {
    return attempt.refined && !attempt.accepted();
  });
}

bool LoopLedger::AnyAccepted() const {
  return std::any_of(attempts_.begin(), attempts_.end(),
                     [](const LoopAttempt& attempt) { return attempt.accepted(); });
}

bool LoopLedger::AcceptedNear(const FrameStore& frames, double path_m, double within_m) const {
  return std::any_of(attempts_.begin(), attempts_.end(), [&](const LoopAttempt& attempt) {
    return attempt.accepted() &&
           std::abs(frames[attempt.found.loop.query].travelled - path_m) < within_m;
  });
}

std::vector<LoopEdge> LoopLedger::AcceptedEdges() const {
  std::vector<LoopEdge> edges;
  for (const LoopAttempt& attempt : attempts_)
    if (attempt.accepted())
      edges.push_back({attempt.found.loop.match, attempt.found.loop.query, &attempt.row()});
  return edges;
}

PathGraph LoopLedger::AcceptedPath(const FrameStore& frames) const {
  PathGraph path;
  for (const LoopEdge& loop : AcceptedEdges())
    path.AddShortcut(frames[loop.query].travelled, frames[loop.match].travelled);
  return path;
}

std::vector<LoopClosure> LoopLedger::Rows() const {
  std::vector<LoopClosure> rows;
  for (const LoopAttempt& attempt : attempts_)
    if (attempt.counts()) rows.push_back(attempt.Measured());
  return rows;
}

}  // namespace sslcd
