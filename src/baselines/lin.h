// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "baselines/consensus.h"
#include "baselines/label_walks.h"

namespace sslcd::baselines {

/// Lin et al.: S. Lin, J. Wang, M. Xu, H. Zhao, Z. Chen, "Topology Aware Object-Level Semantic
/// Mapping Towards More Robust Loop Closure", RA-L 2021. Its authors released no code and the
/// values are ours: docs/baselines.md.
struct LinOptions {
  double edge_m = 20;       ///< objects this close are neighbours
  RandomWalkOptions walks;  ///< the descriptor that finds candidates
  double least_walk_similarity = 0.1;
  /// global objects whose neighbourhood is compared with that of a local one
  int candidates = 40;
  /// edges whose lengths differ by this much are different; 0: lengths do not count
  double edge_tolerance_m = 2;
  double least_similarity = 0.2;  ///< of two neighbourhoods
  ConsensusOptions consensus{5000, 1, 4};
  double accept_score = 0.1;
  int seed = 1;  ///< of the walks and of RANSAC
};
void DescribeFields(FieldVisitor& visitor, LinOptions& options);

/// Random walks find, for each local object, global ones of its label that stand in similar
/// surroundings. The edit distance between their neighbourhoods says how similar, and the
/// assignment that maximises the sum of these similarities is the match of the graphs, aligned by
/// RANSAC and least squares. Score: GraphSimilarity of what was matched, in [0, 1]; taken from
/// `accept_score` on.
std::optional<Answer> MatchLin(const std::vector<LayoutObject>& local,
                               const std::vector<LayoutObject>& global, const LinOptions& options);
PlaceMatcher LinMatcher(const LinOptions& options);

}  // namespace sslcd::baselines
