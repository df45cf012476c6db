// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/gnc.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pose_graph/index.h"

namespace sslcd {
namespace {

// Iterations per weight update. The next update starts at this solution and needs one or two.
constexpr int kInnerIterations = 20;
// Weight updates from each of two starts. They multiply mu by 4e14 at a factor of 1.4.
constexpr int kMaxRounds = 100;
// Share of the chi-square limit; with a smaller chi-square all loops agree.
constexpr double kLeastMisfit = 1e-3;

}  // namespace

double EdgeChi2(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends,
                std::size_t e) {
  const PoseGraph::Edge& edge = graph.edges[e];
  const Vec6 error = EdgeError(edge, graph.vertices[ends[e].first].T_world_vertex,
                               graph.vertices[ends[e].second].T_world_vertex);
  return error.dot(edge.information * error);
}

double GncWeight(double chi2, double mu, double limit) {
  if (chi2 >= (mu + 1) / mu * limit) return 0;
  if (chi2 <= mu / (mu + 1) * limit) return 1;
  return std::sqrt(limit / chi2 * mu * (mu + 1)) - mu;
}

Gnc::Gnc(const PoseGraph& graph, const RobustPoseGraphOptions& options, double limit)
    : graph_(graph),
      ends_(IndexPoseGraph(graph).ends),
      options_(options),
      limit_(limit),
      weights_(ends_.size(), 1.),
      chi2_(ends_.size()) {
  options_.graph.start = PoseGraphStart::kGiven;
  options_.graph.max_iterations = kInnerIterations;
}

void Gnc::Start(double weight) {
  SetWeights([weight](double) { return weight; });
  Solve();
}

void Gnc::Start(const std::vector<double>& weights) {
  std::size_t loop = 0;
  for (std::size_t e = 0; e < ends_.size(); ++e)
    if (graph_.edges[e].loop) weights_[e] = weights[loop++];
  Solve();
}

void Gnc::Graduate() {
  double mu = limit_ / std::max(2 * Worst() - limit_, kLeastMisfit * limit_);
  for (bool undecided = true; undecided && rounds_ < kMaxRounds; mu *= options_.mu_factor) {
    SetWeights([&](double loop_chi2) { return GncWeight(loop_chi2, mu, limit_); });
    undecided =
        std::any_of(weights_.begin(), weights_.end(), [](double w) { return w > 0 && w < 1; });
    Solve();
    ++rounds_;
  }
}

bool Gnc::AllAgree() const {
  const auto loops =
      std::count_if(graph_.edges.begin(), graph_.edges.end(), [](const auto& e) { return e.loop; });
  const double expected = static_cast<double>(loops) * DegreesOfFreedom(options_.graph.freedom);
  return Worst() <= limit_ && std::accumulate(chi2_.begin(), chi2_.end(), 0.) <= expected;
}

double Gnc::Cost() const {
  double cost = 0;
  for (std::size_t e = 0; e < chi2_.size(); ++e)
    cost += graph_.edges[e].loop ? std::min(chi2_[e], limit_) : chi2_[e];
  return cost;
}

void Gnc::Solve() {
  SolvePoseGraph(graph_, options_.graph, weights_);
  for (std::size_t e = 0; e < ends_.size(); ++e) chi2_[e] = EdgeChi2(graph_, ends_, e);
}

double Gnc::Worst() const {
  double worst = 0;
  for (std::size_t e = 0; e < ends_.size(); ++e)
    if (graph_.edges[e].loop) worst = std::max(worst, chi2_[e]);
  return worst;
}

}  // namespace sslcd
