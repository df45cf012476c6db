// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "baselines/consensus.h"
#include "baselines/label_walks.h"

namespace sslcd::baselines {

/// X-View: A. Gawel, C. Del Don, R. Siegwart, J. Nieto, C. Cadena, "X-View: Graph-Based Semantic
/// Multi-View Localization", RA-L 2018 (section III: graph extraction, descriptors, descriptor
/// matching, localisation back-end). docs/baselines.md lists the values of its authors.
struct XViewOptions {
  double edge_m = 10;       ///< objects this close are neighbours
  RandomWalkOptions walks;  ///< the descriptor: m walks of n steps
  double least_similarity = 0.2;
  int candidates = 10;  ///< k: number of global candidates per local object
  ConsensusOptions consensus{5000, 1, 5};
  int seed = 1;
};
void DescribeFields(FieldVisitor& visitor, XViewOptions& options);

/// The similarity of objects with equal labels is the share of identical random walks. The k best
/// candidates of each object, checked for geometric consistency, give the pose. Score: the number
/// of matches; accepts every pose.
std::optional<Answer> MatchXView(const std::vector<LayoutObject>& local,
                                 const std::vector<LayoutObject>& global,
                                 const XViewOptions& options);
PlaceMatcher XViewMatcher(const XViewOptions& options);

}  // namespace sslcd::baselines
