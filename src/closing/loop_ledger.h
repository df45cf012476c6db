// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "closing/loop_finder.h"
#include "closing/loop_graph.h"
#include "closing/path_graph.h"

namespace sslcd {

/// Sightings of an object of the local map and of the one that it was matched with: index of the
/// frame and of the detection in it.
struct MatchedSightings {
  std::pair<int, int> local, global;
};

/// An attempt to close a loop with a candidate.
struct LoopAttempt {
  FoundLoop found;
  /// a sighting of each object of the row's pairs, which says what its landmark is now
  std::vector<MatchedSightings> pairs;
  std::optional<LoopClosure> remeasured;  ///< the row measured in the refined map
  SearchWindow window;
  /// accepted at some time, so it is an edge of the pose graph, which may refuse it
  bool in_graph = false;
  bool solved = false;   ///< a solve of the pose graph has included it
  bool fused = false;    ///< its matched objects were fused
  bool refined = false;  ///< accepted when the trajectory was last refined

  LoopClosure& row() { return found.loop.row; }
  const LoopClosure& row() const { return found.loop.row; }
  bool accepted() const { return row().decision == LoopDecision::kAccepted; }
  /// False: of a second search, and never accepted.
  bool counts() const { return in_graph || !window.second; }
  /// The last measurement.
  const Pose& T_match_query() const;
  /// The row with its last measurement.
  LoopClosure Measured() const;
};

/// All attempts of a run and their decisions. Copyable.
class LoopLedger {
 public:
  /// Adds an attempt. Returns false without adding it if the newest frame has already given a loop
  /// between these cameras.
  bool Add(const FoundLoop& found, const SearchWindow& window, int newest_frame);

  /// Adds the newest attempt, which its finder has accepted, to the pose graph, together with the
  /// confirmed attempts of its track.
  void AcceptNewest();

  /// Adds a loop of a camera whose own attempt is still to come (LoopClosure::early). It is a row,
  /// but no attempt: no correction and no prior of a search has it.
  void AddEarly(const FoundLoop& found, int newest_frame);
  /// Removes the early loops with a query camera before `path_m`, and those that were found with an
  /// attempt that is no longer accepted.
  void DropEarly(const FrameStore& frames, double path_m);
  const std::vector<LoopAttempt>& early() const { return early_; }

  /// Of a ledger that this one was a copy of: attempts that `other` has made, too, get its ids,
  /// also later ones, and attempts that it has not made get others than it has used.
  void ReserveIds(const LoopLedger& other);

  /// Removes the attempts of the second search that were never accepted.
  void DropUnacceptedOfSecond();

  /// Whether objects were fused by a loop that is no longer accepted.
  bool FusedByRefused() const;
  /// To be called when all fused landmarks were split.
  void ForgetFusions();

  /// To be called when the trajectory was refined with the accepted loops.
  void MarkRefined();
  /// Whether that trajectory has a loop that is no longer accepted.
  bool RefinedByRefused() const;

  std::vector<LoopAttempt>& attempts() {
    ++revision_;
    return attempts_;
  }
  const std::vector<LoopAttempt>& attempts() const { return attempts_; }

  /// Counts what may have been changes.
  int revision() const { return revision_; }

  bool AnyAccepted() const;
  /// Whether there is an accepted loop with a query camera within `within_m` of this path length.
  bool AcceptedNear(const FrameStore& frames, double path_m, double within_m) const;
  /// The same, or an early loop.
  bool AnyLoopNear(const FrameStore& frames, double path_m, double within_m) const;
  /// Edges of the accepted loops.
  std::vector<LoopEdge> AcceptedEdges() const;
  /// The path with the accepted loops as shortcuts.
  PathGraph AcceptedPath(const FrameStore& frames) const;
  /// LoopAttempt::Measured of all attempts in order, but for those of a second search that were
  /// never accepted; then the early loops.
  std::vector<LoopClosure> Rows() const;

 private:
  using Key = std::array<int, 4>;  // newest, query and match frame, whether early
  static Key KeyOf(const LoopMeasurement& loop, int newest_frame, bool early = false) {
    return {newest_frame, loop.query, loop.match, early};
  }
  static Key KeyOf(const LoopAttempt& attempt) {
    return KeyOf(attempt.found.loop, attempt.row().newest_frame, attempt.row().early);
  }

  int IdOf(const Key& key);
  void AvoidIds(int first_free, std::vector<LoopAttempt>& attempts);

  std::vector<LoopAttempt> attempts_, early_;
  std::map<Key, int> reserved_;  // ids
  int next_id_ = 0, revision_ = 0;
};

}  // namespace sslcd
