// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/tree.h"

#include <Eigen/Cholesky>

#include <queue>

#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix6 Covariance(const PoseGraph::Edge& edge) {
  return Eigen::LLT<Matrix6>(edge.information).solve(Matrix6::Identity());
}

}  // namespace

TrustedTree::TrustedTree(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends) {
  const std::size_t count = graph.vertices.size();
  std::vector<std::vector<int>> edges(count);
  for (std::size_t e = 0; e < ends.size(); ++e) {
    if (graph.edges[e].loop) continue;
    edges[ends[e].first].push_back(static_cast<int>(e));
    edges[ends[e].second].push_back(static_cast<int>(e));
  }
  parent_.assign(count, -1);
  depth_.assign(count, -1);
  covariance_.assign(count, Matrix6::Zero());
  for (const auto& vertex : graph.vertices) poses_.push_back(vertex.T_world_vertex);
  for (std::size_t root = 0; root < count; ++root) {
    if (depth_[root] >= 0) continue;
    depth_[root] = 0;
    std::queue<int> queue({static_cast<int>(root)});
    for (; !queue.empty(); queue.pop()) {
      const int at = queue.front();
      for (const int e : edges[at]) {
        const bool forward = ends[e].first == at;
        const int next = forward ? ends[e].second : ends[e].first;
        if (depth_[next] >= 0) continue;
        const PoseGraph::Edge& edge = graph.edges[e];
        parent_[next] = at;
        depth_[next] = depth_[at] + 1;
        poses_[next] = poses_[at] * (forward ? edge.T_from_to : edge.T_from_to.inverse());
        // The measurement's error acts at its `to`: T Exp(a) = Exp(Adj(T) a) T.
        const Matrix6 adjoint = poses_[ends[e].second].Adj();
        covariance_[next] = covariance_[at] + adjoint * Covariance(edge) * adjoint.transpose();
        queue.push(next);
      }
    }
  }
}

double TrustedTree::Disagreement(const PoseGraph::Edge& edge, int from, int to) const {
  int a = from, b = to;  // walk up from both until they meet
  while (a != b && a >= 0 && b >= 0)
    (depth_[a] >= depth_[b] ? a : b) = parent_[depth_[a] >= depth_[b] ? a : b];
  if (a != b) return 0;
  const Matrix6 adjoint = poses_[to].inverse().Adj();
  const Matrix6 way = covariance_[from] + covariance_[to] - 2 * covariance_[a];
  const Matrix6 sum = Covariance(edge) + adjoint * way * adjoint.transpose();
  const Vec6 error = EdgeError(edge, poses_[from], poses_[to]);
  return error.dot(Eigen::LLT<Matrix6>(sum).solve(error));
}

}  // namespace sslcd
