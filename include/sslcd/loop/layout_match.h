// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/layout.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/loop/options.h"

namespace SSLCD_EXPORT sslcd {

/// How well a local layout agrees with the global one under a pose.
struct LayoutFit {
  /// pairs of local and global index, one to one, sorted by local index
  std::vector<std::pair<int, int>> matches;
  /// log likelihood ratio of the layout under the pose [nats]
  double score = 0;
  /// the same for a pose that was found by a search in this map: chance reaches 0
  double evidence = 0;
  /// horizontal standard deviation per axis of the matched objects [m]
  double sigma = 0;
  int should_see = 0;  ///< number of map objects in the area of the local ones, matched or not
};

/// A pose that the local layout may have in the global one.
struct PoseHypothesis {
  YawShift pose;  ///< local to global
  LayoutFit fit;  ///< fit of the layouts under the pose
};

/// The pose of the local map in the global one, or the reason of the refusal.
struct LayoutAnswer : LoopVerdict {
  /// Distinct poses, best first; may be empty. The answer is the first. Matches are indices into
  /// the objects as given.
  std::vector<PoseHypothesis> hypotheses;
  std::size_t looked_at = 0;  ///< number of coarse poses that the search has scored
  /// Log of the sum of exp(evidence) of those that it has not refined, estimated; known in large
  /// maps only, where it counts against the answer (docs/decision.md). [nats]
  double left_out = -std::numeric_limits<double>::infinity();
};

/// Searches the pose of the local map in the global one without a prior and decides whether to
/// accept it. Uses labels, positions and all known properties of the objects. Ignores objects whose
/// position is not finite. Before it accepts a pose, it also searches the mirror image of the local
/// map: no camera sees mirror images, so their score is that of chance. Deterministic. Never
/// throws; the verdict has the reason of a failure.
LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local,
                          const std::vector<LayoutObject>& global,
                          const LayoutMatchOptions& options = {},
                          const SingleLookOptions& decision = {});

}  // namespace sslcd
