// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "closing/loop_finder.h"
#include "closing/loop_graph.h"
#include "closing/path_graph.h"
#include "refine/fuse.h"

namespace sslcd {

/// An attempt to close a loop with a candidate.
struct LoopAttempt {
  FoundLoop found;
  /// matched pairs of the row with current ids
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;
  std::optional<LoopClosure> remeasured;  ///< the row measured in the refined map
  SearchWindow window;
  /// accepted at some time, so it is an edge of the pose graph, which may refuse it
  bool in_graph = false;
  bool solved = false;  ///< a solve of the pose graph has included it

  LoopClosure& row() { return found.loop.row; }
  const LoopClosure& row() const { return found.loop.row; }
  bool accepted() const { return row().decision == LoopDecision::kAccepted; }
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

  /// Removes attempts from index `first` on that were never accepted.
  void DropUnaccepted(std::size_t first);

  /// Updates the ids of fused landmarks.
  void Rename(const MergedIds& merged);

  std::vector<LoopAttempt>& attempts() { return attempts_; }
  const std::vector<LoopAttempt>& attempts() const { return attempts_; }

  bool AnyAccepted() const;
  /// Whether there is an accepted loop with a query camera within `within_m` of this path length.
  bool AcceptedNear(const FrameStore& frames, double path_m, double within_m) const;
  /// Edges of the accepted loops.
  std::vector<LoopEdge> AcceptedEdges() const;
  /// The path with the accepted loops as shortcuts.
  PathGraph AcceptedPath(const FrameStore& frames) const;
  /// The rows of all attempts in order, with their last measurement.
  std::vector<LoopClosure> Rows() const;

 private:
  std::vector<LoopAttempt> attempts_;
};

}  // namespace sslcd
