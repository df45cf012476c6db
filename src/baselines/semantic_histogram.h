// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "baselines/consensus.h"
#include "baselines/label_walks.h"

namespace sslcd::baselines {

/// Semantic histograms: X. Guo, J. Hu, J. Chen, F. Deng, T. L. Lam, "Semantic Histogram Based Graph
/// Matching for Real-Time Multi-Robot Global Localization in Large Scale Environment", RA-L 2021.
/// docs/baselines.md says which of the values are its authors'.
struct SemanticHistogramOptions {
  double edge_m = 10;   ///< objects this close are neighbours
  int path_length = 3;  ///< objects on a path, the one described included
  double least_similarity = 0.5;
  int candidates = 1;  ///< global objects that each local one may be
  ConsensusOptions consensus{1000, 1, 5};
  int seed = 1;  ///< of RANSAC
};
void DescribeFields(FieldVisitor& visitor, SemanticHistogramOptions& options);

/// An object is described by the histogram of the labels along all paths from it; objects of equal
/// labels are as similar as the normalised inner product of their histograms. The best ones give
/// the pose by RANSAC and least squares. Score: the number of matches; every pose is taken.
std::optional<Answer> MatchSemanticHistogram(const std::vector<LayoutObject>& local,
                                             const std::vector<LayoutObject>& global,
                                             const SemanticHistogramOptions& options);
PlaceMatcher SemanticHistogramMatcher(const SemanticHistogramOptions& options);

}  // namespace sslcd::baselines
