// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/optim/pose_graph_robust.h"

#include <algorithm>
#include <cmath>

#include "optim/pose_graph_chains.h"
#include "optim/pose_graph_index.h"
#include "optim/pose_graph_tree.h"

namespace sslcd {
namespace {

constexpr int kInnerIterations = 3;  // per weight update: the next one starts where this one ended

double EdgeChi2(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends, std::size_t e) {
  const PoseGraph::Edge& edge = graph.edges[e];
  const Vec6 error =
      EdgeError(edge, graph.vertices[ends[e].first].T_world_vertex, graph.vertices[ends[e].second].T_world_vertex);
  return error.dot(edge.information * error);
}

// Yang et al. Eq. 14: the weight that minimises the TLS surrogate for one residual.
double Weight(double chi2, double mu, double limit) {
  if (chi2 >= (mu + 1) / mu * limit) return 0;
  if (chi2 <= mu / (mu + 1) * limit) return 1;
  return std::sqrt(limit / chi2 * mu * (mu + 1)) - mu;
}

// GNC over the loops of a graph that starts at its trusted edges' geometry; moves all of its vertices.
void Graduate(PoseGraph& graph, const RobustPoseGraphOptions& options, RobustPoseGraphSummary& summary) {
  CondensedGraph condensed(graph, IndexPoseGraph(graph).ends);
  PoseGraph& small = condensed.graph();
  const std::vector<std::pair<int, int>> ends = IndexPoseGraph(small).ends;
  std::vector<double> weights, chi2(small.edges.size());
  for (const PoseGraph::Edge& edge : small.edges) weights.push_back(edge.loop ? 0 : 1);
  PoseGraphOptions inner = options.graph;
  inner.start = PoseGraphStart::kGiven;
  const auto solve = [&] {
    SolvePoseGraph(small, inner, weights);
    double worst = 0;
    for (std::size_t e = 0; e < ends.size(); ++e)
      if (small.edges[e].loop) worst = std::max(worst, chi2[e] = EdgeChi2(small, ends, e));
    return worst;
  };
  const double limit = summary.chi2_limit, worst = solve();
  inner.max_iterations = kInnerIterations;
  double mu = limit / std::max(2 * worst - limit, 1e-3 * limit);
  for (bool undecided = worst > 0; undecided && summary.rounds < options.max_rounds; mu *= options.mu_factor) {
    undecided = false;
    for (std::size_t e = 0; e < ends.size(); ++e) {
      if (small.edges[e].loop) weights[e] = Weight(chi2[e], mu, limit);
      undecided |= weights[e] > 0 && weights[e] < 1;
    }
    solve();
    ++summary.rounds;
  }
  condensed.Expand(graph);
}

// Keeps the loops within the limit; false if these are the ones kept already.
bool KeepConsistent(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends,
                    RobustPoseGraphSummary& summary) {
  bool changed = !summary.graph.usable;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    if (!graph.edges[e].loop) continue;
    const double weight = EdgeChi2(graph, ends, e) <= summary.chi2_limit ? 1 : 0;
    changed |= weight != summary.edge_weight[e];
    summary.edge_weight[e] = weight;
  }
  return changed;
}

}  // namespace

double Chi2Quantile(double probability, int dof) {
  double low = -40, high = 40;  // the normal distribution's quantile by bisection
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.)) < probability ? low : high) = middle;
  }
  const double v = 2. / (9. * dof);
  return dof * std::pow(1 - v + low * std::sqrt(v), 3);
}

void DescribeFields(FieldVisitor& visitor, RobustPoseGraphOptions& options) {
  visitor.Nested("graph", options.graph, "the solver");
  visitor.Real("inlier_probability", options.inlier_probability, 0.5, 1 - 1e-9,
               "a true loop passes with this probability");
  visitor.Real("drift_factor", options.drift_factor, 1, 1e6,
               "a loop is ruled out where odometry would have to be this many times worse than its information says");
  visitor.Real("mu_factor", options.mu_factor, 1.01, 100, "how fast the loops' cost turns from convex to truncated");
  visitor.Integer("max_rounds", options.max_rounds, 1, 10000, "weight updates");
}

RobustPoseGraphSummary SolveRobust(PoseGraph& graph, const RobustPoseGraphOptions& options) {
  RobustPoseGraphSummary summary;
  const PoseGraphIndex index = IndexPoseGraph(graph);
  summary.edge_weight.assign(graph.edges.size(), 1.);
  if (!index.trouble.empty()) {
    summary.graph.message = "not optimised: " + index.trouble;
    return summary;
  }
  summary.chi2_limit = Chi2Quantile(options.inlier_probability, DegreesOfFreedom(options.graph.freedom));
  const TrustedTree tree(graph, index.ends);
  PoseGraph candidates;  // with the loops that odometry does not rule out
  candidates.vertices = graph.vertices;
  for (std::size_t v = 0; v < graph.vertices.size(); ++v)
    if (!graph.vertices[v].fixed) candidates.vertices[v].T_world_vertex = tree.poses()[v];
  const double ruled_out = summary.chi2_limit * options.drift_factor * options.drift_factor;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const PoseGraph::Edge& edge = graph.edges[e];
    if (!edge.loop || tree.Disagreement(edge, index.ends[e].first, index.ends[e].second) <= ruled_out)
      candidates.edges.push_back(edge);
  }
  Graduate(candidates, options, summary);
  for (std::size_t v = 0; v < graph.vertices.size(); ++v)
    graph.vertices[v].T_world_vertex = candidates.vertices[v].T_world_vertex;

  // All loops are judged by where that leads, those that were ruled out, too; a few times, until nothing changes.
  PoseGraphOptions final_solve = options.graph;
  for (int i = 0; i < 5 && KeepConsistent(graph, index.ends, summary); ++i) {
    summary.graph = SolvePoseGraph(graph, final_solve, summary.edge_weight);
    if (!summary.graph.usable) break;
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (graph.edges[e].loop) ++(summary.edge_weight[e] > 0 ? summary.loops_kept : summary.loops_refused);
  return summary;
}

}  // namespace sslcd
