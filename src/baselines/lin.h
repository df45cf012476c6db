// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "baselines/consensus.h"
#include "baselines/label_walks.h"

namespace sslcd::baselines {

/// Lin et al.: S. Lin, J. Wang, M. Xu, H. Zhao, Z. Chen, "Topology Aware Object-Level Semantic
/// Mapping Towards More Robust Loop Closure", RA-L 2021. Its authors released no code;
/// docs/baselines.md explains the values.
struct LinOptions {
  double edge_m = 20;       ///< objects this close are neighbours
  RandomWalkOptions walks;  ///< the descriptor that finds candidates
  double least_walk_similarity = 0.1;
  /// number of global objects per local one whose neighbourhoods are compared
  int candidates = 40;
  /// smallest length difference of different edges; 0: ignores lengths
  double edge_tolerance_m = 2;
  double least_similarity = 0.2;  ///< smallest similarity of two neighbourhoods
  ConsensusOptions consensus{5000, 1, 4};
  double accept_score = 0.1;
  int seed = 1;  ///< of the walks and of RANSAC
};
void DescribeFields(FieldVisitor& visitor, LinOptions& options);

/// Random walks find, for each local object, global candidates of its label with similar
/// surroundings. The edit distance of their neighbourhoods gives similarities, and the assignment
/// with the largest sum of these is the match of the graphs. RANSAC and least squares align it.
/// Score: GraphSimilarity of the match, in [0, 1]; accepted from `accept_score` on.
std::optional<Answer> MatchLin(const std::vector<LayoutObject>& local,
                               const std::vector<LayoutObject>& global, const LinOptions& options);
PlaceMatcher LinMatcher(const LinOptions& options);

}  // namespace sslcd::baselines
