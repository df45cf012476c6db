// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/semantic_histogram.h"

namespace sslcd::baselines {

void DescribeFields(FieldVisitor& visitor, SemanticHistogramOptions& options) {
  visitor.Real("edge_m", options.edge_m, 0, 1e6, "objects this close are neighbours");
  visitor.Integer("path_length", options.path_length, 2, 6,
                  "objects on a path, the one described included");
  visitor.Real("least_similarity", options.least_similarity, 0, 1,
               "inner product that a match needs");
  visitor.Integer("candidates", options.candidates, 1, 1000,
                  "global objects that each local one may be");
  visitor.Nested("consensus", options.consensus, "geometric consistency");
  visitor.Integer("seed", options.seed, 0, 1000000000, "of RANSAC");
}

std::optional<Answer> MatchSemanticHistogram(const std::vector<LayoutObject>& local,
                                             const std::vector<LayoutObject>& global,
                                             const SemanticHistogramOptions& options) {
  const auto local_histograms =
      AllWalks(MakeLabelGraph(local, options.edge_m), options.path_length - 1);
  const auto global_histograms =
      AllWalks(MakeLabelGraph(global, options.edge_m), options.path_length - 1);
  Eigen::MatrixXd similarity = Eigen::MatrixXd::Zero(local.size(), global.size());
  for (std::size_t l = 0; l < local.size(); ++l)
    for (std::size_t g = 0; g < global.size(); ++g)
      if (local[l].label == global[g].label)
        similarity(l, g) = Cosine(local_histograms[l], global_histograms[g]);

  const ObjectPairs pairs = BestPairs(similarity, options.least_similarity, options.candidates);
  std::mt19937_64 random(options.seed);
  return LargestConsensus(local, global, pairs, options.consensus, random);
}

PlaceMatcher SemanticHistogramMatcher(const SemanticHistogramOptions& options) {
  return AsPlaceMatcher([options](const auto& local, const auto& global) {
    return MatchSemanticHistogram(local, global, options);
  });
}

}  // namespace sslcd::baselines
