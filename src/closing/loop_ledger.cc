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
  attempt.row().id = IdOf(key);
  attempt.row().newest_frame = newest_frame;
  ++revision_;
  attempt.window = window;
  return true;
}

// The id that another ledger has given, or a new one.
int LoopLedger::IdOf(const Key& key) {
  const auto reserved = reserved_.find(key);
  return reserved != reserved_.end() ? reserved->second : next_id_++;
}

void LoopLedger::AddEarly(const FoundLoop& found, int newest_frame) {
  ++revision_;
  LoopAttempt& attempt = early_.emplace_back();
  attempt.found = found;
  attempt.row().id = IdOf(KeyOf(found.loop, newest_frame, true));
  attempt.row().newest_frame = newest_frame;
  attempt.row().early = true;
}

void LoopLedger::DropEarly(const FrameStore& frames, double path_m) {
  if (early_.empty()) return;
  std::set<int> accepted;  // newest frames of the attempts with early loops
  for (const LoopAttempt& attempt : attempts_)
    if (attempt.accepted() && !attempt.window.second) accepted.insert(attempt.row().newest_frame);
  const auto ends = [&](const LoopAttempt& early) {
    return frames[early.found.loop.query].travelled < path_m ||
           accepted.count(early.row().newest_frame) == 0;
  };
  const auto ended = std::remove_if(early_.begin(), early_.end(), ends);
  if (ended != early_.end()) ++revision_;
  early_.erase(ended, early_.end());
}

void LoopLedger::ReserveIds(const LoopLedger& other) {
  for (const std::vector<LoopAttempt>* all : {&other.attempts_, &other.early_})
    for (const LoopAttempt& attempt : *all) reserved_[KeyOf(attempt)] = attempt.row().id;
  next_id_ = std::max(next_id_, other.next_id_);
  AvoidIds(other.next_id_, attempts_);
  AvoidIds(other.next_id_, early_);
}

// Ids before `first_free` may be those of early loops that have ended in the other ledger.
void LoopLedger::AvoidIds(int first_free, std::vector<LoopAttempt>& attempts) {
  for (LoopAttempt& attempt : attempts) {
    const auto reserved = reserved_.find(KeyOf(attempt));
    if (reserved != reserved_.end())
      attempt.row().id = reserved->second;
    else if (attempt.row().id < first_free)
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

bool LoopLedger::AnyLoopNear(const FrameStore& frames, double path_m, double within_m) const {
  return AcceptedNear(frames, path_m, within_m) ||
         std::any_of(early_.begin(), early_.end(), [&](const LoopAttempt& early) {
           return std::abs(frames[early.found.loop.query].travelled - path_m) < within_m;
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
  for (const LoopAttempt& early : early_) rows.push_back(early.row());
  return rows;
}

}  // namespace sslcd
