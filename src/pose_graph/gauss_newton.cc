// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pose_graph/block_cholesky.h"
#include "pose_graph/cost.h"

namespace sslcd {
namespace {

using Ends = std::vector<std::pair<int, int>>;
using Block = BlockCholesky::Block;

// The largest entries of gradient and step below which rounding is larger, as in Ceres.
constexpr double kLeastGradient = 1e-10, kLeastStep = 1e-8;

// The normal equations at `poses`. `unknown` is the position of a vertex in them, -1 if anchored.
void Linearise(const PoseGraphProblem& problem, const std::vector<int>& unknown,
               const std::vector<Pose>& poses, BlockCholesky& normal,
               BlockCholesky::Vector<1>& gradient) {
  const auto& [graph, ends, weights, anchored] = problem;
  normal.SetZero();
  std::fill(gradient.begin(), gradient.end(), Vec6::Zero());
  for (std::size_t e = 0; e < ends.size(); ++e) {
    if (!(weights[e] > 0)) continue;
    const auto [from, to] = ends[e];
    const EdgeLinearisation edge =
        LineariseEdge(graph.edges[e].T_from_to.inverse(), poses[from], poses[to]);
    const Block information = weights[e] * graph.edges[e].information;
    const Block I_from = information.lazyProduct(edge.J_from),
                I_to = information.lazyProduct(edge.J_to);
    const int i = unknown[from], j = unknown[to];
    if (i >= 0) {
      normal.Add(i, i, edge.J_from.transpose().lazyProduct(I_from));
      gradient[i] += I_from.transpose() * edge.error;
    }
    if (j >= 0) {
      normal.Add(j, j, edge.J_to.transpose().lazyProduct(I_to));
      gradient[j] += I_to.transpose() * edge.error;
    }
    if (i >= 0 && j >= 0) normal.Add(i, j, edge.J_from.transpose().lazyProduct(I_to));
  }
}

// Infinite if an entry is no number.
double LargestEntry(const BlockCholesky::Vector<1>& vector) {
  double largest = 0;
  for (const auto& each : vector) {
    if (!each.allFinite()) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, each.cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace

GaussNewtonSummary GaussNewton(const PoseGraphProblem& problem, const PoseGraphOptions& options,
                               std::vector<Pose>& poses) {
  const auto& [graph, ends, weights, anchored] = problem;
  std::vector<int> unknown(poses.size(), -1);
  int unknowns = 0;
  for (std::size_t v = 0; v < poses.size(); ++v)
    if (!anchored[v]) unknown[v] = unknowns++;
  Ends pairs;
  for (std::size_t e = 0; e < ends.size(); ++e)
    if (weights[e] > 0 && unknown[ends[e].first] >= 0 && unknown[ends[e].second] >= 0)
      pairs.push_back({unknown[ends[e].first], unknown[ends[e].second]});
  BlockCholesky normal(unknowns, pairs);
  BlockCholesky::Vector<1> gradient(unknowns);
  double chi2 = Chi2Of(graph, ends, weights, poses);
  GaussNewtonSummary summary;
  if (!std::isfinite(chi2)) return {GaussNewtonEnd::kStuck, 0};
  while (summary.steps < options.max_iterations) {
    Linearise(problem, unknown, poses, normal, gradient);
    if (LargestEntry(gradient) <= kLeastGradient)
      return {GaussNewtonEnd::kConverged, summary.steps};
    if (!normal.Factorise()) return {GaussNewtonEnd::kStuck, summary.steps};
    const BlockCholesky::Vector<1> d = normal.Solve(gradient);
    std::vector<Pose> moved = poses;
    for (std::size_t v = 0; v < poses.size(); ++v) {
      if (anchored[v]) continue;
      moved[v] = poses[v] * Pose::Exp(-d[unknown[v]]);
      moved[v].normalise();
    }
    const double moved_chi2 = Chi2Of(graph, ends, weights, moved);
    if (!(moved_chi2 <= (1 + options.tolerance) * chi2))
      return {GaussNewtonEnd::kStuck, summary.steps};
    ++summary.steps;
    const bool converged =
        chi2 - moved_chi2 <= options.tolerance * chi2 || LargestEntry(d) <= kLeastStep;
    if (moved_chi2 < chi2) poses = std::move(moved);
    if (converged) return {GaussNewtonEnd::kConverged, summary.steps};
    chi2 = moved_chi2;
  }
  return summary;
}

}  // namespace sslcd
