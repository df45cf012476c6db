// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/core/layout.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/loop/options.h"

namespace sslcd {

class LayoutIndex;

/// How well a local layout agrees with the global one under a pose.
struct LayoutFit {
  /// local index, global index: one to one, in order of the local index
  std::vector<std::pair<int, int>> matches;
  /// log likelihood ratio of the layout under the pose [nats]
  double score = 0;
  double evidence = 0;  ///< the same when the pose is not given but has to be found in this map:
                        ///< below 0, chance does it
  /// how well matched objects agree, horizontally (standard deviation per axis) [m]
  double sigma = 0;
  int should_see = 0;  ///< objects of the map among the local ones' surroundings, matched or not
};

/// A pose that the local layout may have in the global one.
struct PoseHypothesis {
  YawShift pose;  ///< local to global
  LayoutFit fit;  ///< how well the layouts agree under it
};

/// Where the local map lies in the global one, or why that cannot be told.
struct LayoutAnswer : LoopVerdict {
  /// Distinct poses, best first; may be empty. The answer is the first. Matches are indices into
  /// the objects as given.
  std::vector<PoseHypothesis> hypotheses;
};

/// Searches all poses of the local map in the global one and decides whether the best of them can
/// be trusted. Labels, positions and whatever else the objects know take part; there is no prior
/// pose. Objects whose position is not finite take no part. Before a pose is accepted, the mirror
/// image of the local map is searched as well: no camera ever sees it, so what it reaches is
/// chance. Deterministic; never throws for odd layouts, but says so in the verdict.
LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local,
                          const std::vector<LayoutObject>& global,
                          const LayoutMatchOptions& options = {},
                          const SingleLookOptions& decision = {});

/// The same in a map that is searched more than once. Matches are indices into `index.objects()`.
/// For callers inside the library: its header is not installed.
LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                          const LayoutMatchOptions& options = {},
                          const SingleLookOptions& decision = {});

}  // namespace sslcd
