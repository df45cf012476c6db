// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/lin.h"

#include "association/assignment.h"
#include "baselines/edit_distance.h"

namespace sslcd::baselines {

void DescribeFields(FieldVisitor& visitor, LinOptions& options) {
  visitor.Real("edge_m", options.edge_m, 0, 1e6, "objects this close are neighbours");
  visitor.Nested("walks", options.walks, "the descriptor that finds candidates");
  visitor.Real("least_walk_similarity", options.least_walk_similarity, 0, 1, "of a candidate");
  visitor.Integer("candidates", options.candidates, 1, 1000,
                  "global objects compared with each local one");
  visitor.Real("edge_tolerance_m", options.edge_tolerance_m, 0, 1e6,
               "edges whose lengths differ by this much are different; 0: lengths do not count");
  visitor.Real("least_similarity", options.least_similarity, 0, 1,
               "of the neighbourhoods of a match");
  visitor.Nested("consensus", options.consensus, "alignment");
  visitor.Real("accept_score", options.accept_score, 0, 1, "a loop has at least this score");
  visitor.Integer("seed", options.seed, 0, 1000000000, "of the walks and of RANSAC");
}

std::optional<Answer> MatchLin(const std::vector<LayoutObject>& local,
                               const std::vector<LayoutObject>& global, const LinOptions& options) {
  const LabelGraph local_graph = MakeLabelGraph(local, options.edge_m);
  const LabelGraph global_graph = MakeLabelGraph(global, options.edge_m);
  std::mt19937_64 random(options.seed);
  const auto local_walks = RandomWalks(local_graph, options.walks, random);
  const auto global_walks = RandomWalks(global_graph, options.walks, random);
  Eigen::MatrixXd by_walks = Eigen::MatrixXd::Zero(local.size(), global.size());
  for (std::size_t l = 0; l < local.size(); ++l)
    for (std::size_t g = 0; g < global.size(); ++g)
      if (local[l].label == global[g].label)
        by_walks(l, g) = CommonShare(local_walks[l], global_walks[g]);

  Eigen::MatrixXd by_edits = Eigen::MatrixXd::Zero(local.size(), global.size());
  for (const auto& [l, g] :
       BestPairs(by_walks, options.least_walk_similarity, options.candidates)) {
    const double similarity =
        StarSimilarity(SpokesOf(local, local_graph, l), SpokesOf(global, global_graph, g),
                       options.edge_tolerance_m);
    if (similarity >= options.least_similarity) by_edits(l, g) = similarity;
  }
  ObjectPairs pairs;
  const std::vector<int> assigned = MaximumAssignment(by_edits);
  for (std::size_t l = 0; l < local.size(); ++l)
    if (assigned[l] >= 0) pairs.emplace_back(static_cast<int>(l), assigned[l]);

  std::optional<Answer> answer = LargestConsensus(local, global, pairs, options.consensus, random);
  if (!answer) return std::nullopt;
  answer->score = GraphSimilarity(local_graph, global_graph, answer->matches);
  answer->accepted = answer->score >= options.accept_score;
  return answer;
}

PlaceMatcher LinMatcher(const LinOptions& options) {
  return AsPlaceMatcher([options](const auto& local, const auto& global) {
    return MatchLin(local, global, options);
  });
}

}  // namespace sslcd::baselines
