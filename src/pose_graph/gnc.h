// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {

/// e^T I e of edge e, whose vertices are ends[e].
double EdgeChi2(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends,
                std::size_t e);

/// Yang et al. 2020, Eq. 14: the weight in [0, 1] that minimises the surrogate
/// w chi2 + mu (1 - w) / (mu + w) limit of a truncated squared error.
double GncWeight(double chi2, double mu, double limit);

/// Truncated least squares over the loops of a graph by graduated non-convexity, from given initial
/// values.
class Gnc {
 public:
  /// `graph` must be well-formed. A loop's chi2 counts up to `limit`.
  Gnc(const PoseGraph& graph, const RobustPoseGraphOptions& options, double limit);

  /// Solves with all loops on (1) or off (0).
  void Start(double weight);
  /// Solves with the weight of each loop, in the order of the edges.
  void Start(const std::vector<double>& weights);

  /// Updates weights and solution until no loop is left between 0 and 1.
  void Graduate();

  /// Whether the total chi2 is plausible for true loops and no single loop is an outlier.
  bool AllAgree() const;

  /// Sum of the edges' chi2; a loop beyond the limit costs the limit.
  double Cost() const;

  const PoseGraph& graph() const { return graph_; }
  int rounds() const { return rounds_; }  ///< weight updates

 private:
  template <class WeightOfChi2>
  void SetWeights(const WeightOfChi2& weight) {
    for (std::size_t e = 0; e < ends_.size(); ++e)
      if (graph_.edges[e].loop) weights_[e] = weight(chi2_[e]);
  }
  void Solve();
  double Worst() const;  // largest chi2 of a loop

  PoseGraph graph_;
  std::vector<std::pair<int, int>> ends_;
  RobustPoseGraphOptions options_;
  double limit_;
  std::vector<double> weights_, chi2_;  // per edge
  int rounds_ = 0;
};

}  // namespace sslcd
