// SPDX-License-Identifier: BSD-3-Clause
#include "loop/layout.h"

namespace sslcd {

std::optional<Eigen::VectorXd> LayoutVector(const ObjectGraph& graph, int id, int k) {
  const std::vector<GraphEdge> edges = graph.Neighbours(id, k);  // nearest first: sorted
  if (edges.empty() || static_cast<int>(edges.size()) < k) return std::nullopt;
  Eigen::VectorXd w(k);
  for (int i = 0; i < k; ++i) w[i] = edges[i].distance_m;
  const double sum = w.sum();
  if (!(sum > 0)) return std::nullopt;
  return w / sum;
}

double LayoutDifference(const Eigen::VectorXd& local, const Eigen::VectorXd& global) {
  return (local - global).norm();
}

}  // namespace sslcd
