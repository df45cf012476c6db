// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "baselines/consensus.h"
#include "baselines/label_walks.h"

namespace sslcd::baselines {

/// Semantic histograms: X. Guo, J. Hu, J. Chen, F. Deng, T. L. Lam, "Semantic Histogram Based Graph
/// Matching for Real-Time Multi-Robot Global Localization in Large Scale Environment", RA-L 2021.
/// docs/baselines.md lists the values of its authors.
struct SemanticHistogramOptions {
  double edge_m = 10;   ///< objects this close are neighbours
  int path_length = 3;  ///< number of objects on a path, including the described one
  double least_similarity = 0.5;
  int candidates = 1;  ///< number of global candidates per local object
  ConsensusOptions consensus{1000, 1, 5};
  int seed = 1;  ///< of RANSAC
};
void DescribeFields(FieldVisitor& visitor, SemanticHistogramOptions& options);

/// The descriptor of an object is the histogram of the labels along all paths from it. The
/// similarity of objects with equal labels is the normalised inner product of their histograms.
/// RANSAC and least squares over the best pairs give the pose. Score: the number of matches;
/// accepts every pose.
std::optional<Answer> MatchSemanticHistogram(const std::vector<LayoutObject>& local,
                                             const std::vector<LayoutObject>& global,
                                             const SemanticHistogramOptions& options);
PlaceMatcher SemanticHistogramMatcher(const SemanticHistogramOptions& options);

}  // namespace sslcd::baselines
