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

/// An attempt to close a loop that had something to compare.
struct LoopAttempt {
  FoundLoop found;
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;  ///< the row's, by the ids they have now
  std::optional<LoopClosure> remeasured;                 ///< the row as the refined map measures it
  SearchWindow window;
  /// accepted at some time: an edge of the pose graph, which may refuse it
  bool in_graph = false;
  bool solved = false;  ///< the pose graph was solved with it

  LoopClosure& row() { return found.loop.row; }
  const LoopClosure& row() const { return found.loop.row; }
  bool accepted() const { return row().decision == LoopDecision::kAccepted; }
};

/// What has become of every attempt of a run. Copyable.
class LoopLedger {
 public:
  /// False, and no entry: the newest frame has led to these two cameras before.
  bool Add(const FoundLoop& found, const SearchWindow& window, int newest_frame);

  /// Enters the newest attempt, which its finder has accepted, into the pose graph, and with it the
  /// confirmed attempts of the same track.
  void AcceptNewest(const FrameStore& frames);

  /// Forgets attempts from the `first` one on that were never accepted.
  void DropUnaccepted(std::size_t first);

  /// Landmarks were fused.
  void Rename(const MergedIds& merged);

  std::vector<LoopAttempt>& attempts() { return attempts_; }
  const std::vector<LoopAttempt>& attempts() const { return attempts_; }

  bool AnyAccepted() const;
  /// Whether a loop with a query camera within `within_m` of that point of the path is accepted.
  bool AcceptedNear(const FrameStore& frames, double path_m, double within_m) const;
  /// Edges of the accepted loops.
  std::vector<LoopEdge> AcceptedEdges() const;
  /// The path, with the accepted loops as shortcuts.
  PathGraph AcceptedPath(const FrameStore& frames) const;
  /// The same with all loops accepted since the last call of ResetPath, refused ones too.
  const PathGraph& path() const { return path_; }
  void ResetPath(const FrameStore& frames) { path_ = AcceptedPath(frames); }
  /// Every attempt, in order, as it was measured last.
  std::vector<LoopClosure> Rows() const;

 private:
  void Enter(LoopAttempt& attempt, const FrameStore& frames);

  std::vector<LoopAttempt> attempts_;
  PathGraph path_;
};

}  // namespace sslcd
