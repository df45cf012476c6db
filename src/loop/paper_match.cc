// SPDX-License-Identifier: BSD-3-Clause
#include "loop/paper_match.h"

#include "loop/layout.h"
#include "loop/object_graph.h"
#include "loop/semantics.h"

namespace sslcd {
namespace {

/// w of every object (IV-A, IV-B).
std::vector<std::optional<Eigen::VectorXd>> LayoutVectors(const std::vector<LayoutObject>& objects,
                                                          int k) {
  ObjectGraph graph;  // by index, since ids may repeat in a combined list
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (objects[i].position.allFinite()) graph.Put(static_cast<int>(i), objects[i].position);
  std::vector<std::optional<Eigen::VectorXd>> vectors;
  for (std::size_t i = 0; i < objects.size(); ++i)
    vectors.push_back(LayoutVector(graph, static_cast<int>(i), k));
  return vectors;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, PaperMatchOptions& options) {
  visitor.Integer("neighbours", options.neighbours, 1, 100,
                  "K: nearest neighbours of a vertex (paper IV-A)");
  visitor.Real("layout_difference", options.layout_difference, 0, 2,
               "delta: candidates differ less than this in their normalised neighbour distances "
               "(IV-B)");
  visitor.Real("mu", options.mu, 0, 1,
               "weight of size and position against colour and embedding (IV-C)");
  visitor.Real("similarity", options.similarity, 1e-9, 2,
               "tau: smallest similarity s_l of a match (IV-C)");
  visitor.Integer("min_matches", options.min_matches, 1, 1000,
                  "fewest matched objects of a loop (IV-D: several)");
}

std::optional<std::vector<ObjectMatch>> PaperMatch(const std::vector<LayoutObject>& local,
                                                   const std::vector<LayoutObject>& global,
                                                   const PaperMatchOptions& options) {
  const auto w_local = LayoutVectors(local, options.neighbours);
  const auto w_global = LayoutVectors(global, options.neighbours);
  std::vector<ObjectMatch> matches;
  for (std::size_t i = 0; i < local.size(); ++i) {
    if (!w_local[i]) continue;
    std::optional<ObjectMatch> best;
    for (std::size_t j = 0; j < global.size(); ++j) {
      if (!w_global[j]) continue;
      const double difference = LayoutDifference(*w_local[i], *w_global[j]);  // Eq. 10
      if (!(difference < options.layout_difference)) continue;
      // Eqs. 11 to 16
      const double similarity = SemanticSimilarity(local[i], global[j], options.mu);
      if (!(similarity >= options.similarity) || (best && similarity <= best->similarity)) continue;
      best = ObjectMatch{static_cast<int>(i), static_cast<int>(j), difference, similarity};
    }
    if (best) matches.push_back(*best);
  }
  if (static_cast<int>(matches.size()) < options.min_matches) return std::nullopt;
  return matches;
}

}  // namespace sslcd
