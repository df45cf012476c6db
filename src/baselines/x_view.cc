// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/x_view.h"

namespace sslcd::baselines {

void DescribeFields(FieldVisitor& visitor, XViewOptions& options) {
  visitor.Real("edge_m", options.edge_m, 0, 1e6, "objects this close are neighbours");
  visitor.Nested("walks", options.walks, "the descriptor of an object");
  visitor.Real("least_similarity", options.least_similarity, 0, 1,
               "share of identical walks that a match needs");
  visitor.Integer("candidates", options.candidates, 1, 1000,
                  "global objects that each local one may be");
  visitor.Nested("consensus", options.consensus, "geometric consistency");
  visitor.Integer("seed", options.seed, 0, 1000000000, "of the walks and of RANSAC");
}

std::optional<Answer> MatchXView(const std::vector<LayoutObject>& local,
                                 const std::vector<LayoutObject>& global,
                                 const XViewOptions& options) {
  std::mt19937_64 random(options.seed);
  const auto local_walks =
      RandomWalks(MakeLabelGraph(local, options.edge_m), options.walks, random);
  const auto global_walks =
      RandomWalks(MakeLabelGraph(global, options.edge_m), options.walks, random);
  Eigen::MatrixXd similarity = Eigen::MatrixXd::Zero(local.size(), global.size());
  for (std::size_t l = 0; l < local.size(); ++l)
    for (std::size_t g = 0; g < global.size(); ++g)
      if (local[l].label == global[g].label)
        similarity(l, g) = CommonShare(local_walks[l], global_walks[g]);

  const ObjectPairs pairs = BestPairs(similarity, options.least_similarity, options.candidates);
  return LargestConsensus(local, global, pairs, options.consensus, random);
}

PlaceMatcher XViewMatcher(const XViewOptions& options) {
  return AsPlaceMatcher([options](const auto& local, const auto& global) {
    return MatchXView(local, global, options);
  });
}

}  // namespace sslcd::baselines
