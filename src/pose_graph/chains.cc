// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/chains.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "pose_graph/index.h"

namespace sslcd {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix6 Inverse(const Matrix6& positive_definite) {
  return Eigen::LLT<Matrix6>(positive_definite).solve(Matrix6::Identity());
}

}  // namespace

CondensedGraph::CondensedGraph(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends)
    : kept_(graph.vertices.size(), -1) {
  const int vertex_count = static_cast<int>(graph.vertices.size());
  Neighbours neighbours(vertex_count);
  std::vector<bool> keep(vertex_count), trusted;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const auto [from, to] = ends[e];
    trusted.push_back(!graph.edges[e].loop);
    if (graph.edges[e].loop) {
      keep[from] = keep[to] = true;
    } else {
      neighbours[from].emplace_back(static_cast<int>(e), to);
      neighbours[to].emplace_back(static_cast<int>(e), from);
    }
  }
  const std::vector<int> component = Components(vertex_count, ends, trusted);
  for (int v = 0, parts = 0; v < vertex_count; ++v) {
    if (component[v] == parts) {  // the first vertex of its component
      keep[v] = true;
      ++parts;
    }
    if (graph.vertices[v].fixed || neighbours[v].size() > 2) keep[v] = true;
  }
  for (int v = 0; v < vertex_count; ++v) {
    if (!keep[v]) continue;
    kept_[v] = static_cast<int>(condensed_.vertices.size());
    condensed_.vertices.push_back(graph.vertices[v]);
  }
  for (const PoseGraph::Edge& edge : graph.edges)
    if (edge.loop) condensed_.edges.push_back(edge);

  std::vector<bool> used(ends.size());
  for (int v = 0; v < vertex_count; ++v) {
    if (!keep[v]) continue;
    for (const auto& [edge, unused] : neighbours[v]) {
      if (used[edge]) continue;
      chains_.push_back(Follow(v, edge, graph, ends, neighbours, used));
      const Chain& chain = chains_.back();
      if (chain.dangling || chain.links.back().vertex == v) continue;
      Pose T;
      Matrix6 covariance = Matrix6::Zero();
      for (const Link& link : chain.links) {  // Exp(a) T = T Exp(Adj(T^-1) a)
        const Matrix6 adjoint = link.T_before_here.inverse().Adj();
        covariance = adjoint * covariance * adjoint.transpose() + link.covariance;
        T *= link.T_before_here;
      }
      condensed_.edges.push_back({graph.vertices[v].id,
                                  graph.vertices[chain.links.back().vertex].id, T,
                                  Inverse(covariance)});
    }
  }
}

CondensedGraph::Chain CondensedGraph::Follow(int start, int edge, const PoseGraph& full,
                                             const std::vector<std::pair<int, int>>& ends,
                                             const Neighbours& neighbours,
                                             std::vector<bool>& used) const {
  Chain chain{start, {}, false};
  int at = start;
  while (true) {
    used[edge] = true;
    const PoseGraph::Edge& measured = full.edges[edge];
    Link link{ends[edge].second, measured.T_from_to, Inverse(measured.information)};
    if (ends[edge].first != at) {  // against the edge: (T Exp(a))^-1 = T^-1 Exp(-Adj(T) a)
      const Matrix6 adjoint = measured.T_from_to.Adj();
      link = {at = ends[edge].first, measured.T_from_to.inverse(),
              adjoint * link.covariance * adjoint.transpose()};
    }
    at = link.vertex;
    chain.links.push_back(link);
    if (kept_[at] >= 0) return chain;
    int next = -1;
    for (const auto& [other, unused] : neighbours[at])
      if (!used[other]) next = other;
    if (next < 0) {
      chain.dangling = true;
      return chain;
    }
    edge = next;
  }
}

void CondensedGraph::Expand(PoseGraph& full) const {
  for (std::size_t v = 0; v < kept_.size(); ++v)
    if (kept_[v] >= 0)
      full.vertices[v].T_world_vertex = condensed_.vertices[kept_[v]].T_world_vertex;
  for (const Chain& chain : chains_) {
    // Adjoint of each link's end seen from the chain's end, and the covariance of the whole.
    std::vector<Matrix6> adjoints(chain.links.size());
    Pose T_here_end;
    Matrix6 covariance = Matrix6::Zero();
    for (std::size_t i = chain.links.size(); i-- > 0;) {
      adjoints[i] = T_here_end.inverse().Adj();
      covariance += adjoints[i] * chain.links[i].covariance * adjoints[i].transpose();
      T_here_end = chain.links[i].T_before_here * T_here_end;
    }
    Pose T = full.vertices[chain.start].T_world_vertex;
    Pose::Tangent share = Pose::Tangent::Zero();
    if (!chain.dangling) {
      const Pose& T_world_end = full.vertices[chain.links.back().vertex].T_world_vertex;
      const Pose::Tangent misfit = ((T * T_here_end).inverse() * T_world_end).Log();
      share = Eigen::LLT<Matrix6>(covariance).solve(misfit);
    }
    for (std::size_t i = 0; i < chain.links.size(); ++i) {
      const Link& link = chain.links[i];
      T = T * link.T_before_here * Pose::Exp(link.covariance * (adjoints[i].transpose() * share));
      if (kept_[link.vertex] < 0) full.vertices[link.vertex].T_world_vertex = T;
    }
  }
}

PoseGraphSummary SolveCondensed(PoseGraph& graph, const PoseGraphOptions& options,
                                const std::vector<double>& loop_weights) {
  CondensedGraph condensed(graph, IndexPoseGraph(graph).ends);
  PoseGraphOptions inner = options;
  inner.start = PoseGraphStart::kGiven;
  const PoseGraphSummary summary = SolvePoseGraph(condensed.graph(), inner, loop_weights);
  if (summary.usable) condensed.Expand(graph);
  return summary;
}

}  // namespace sslcd
