// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {

/// What is minimised: chi2 = sum_e weights_e e^T I_e e over the edges of `graph`, e = EdgeError(),
/// where the poses of `anchored` vertices stay. Every component needs an anchor.
struct PoseGraphProblem {
  const PoseGraph& graph;
  const std::vector<std::pair<int, int>>& ends;  ///< as in PoseGraphIndex
  const std::vector<double>& weights;            ///< per edge; 0: left out
  const std::vector<bool>& anchored;             ///< per vertex
};

enum class GaussNewtonEnd {
  kConverged,
  kTooManySteps,
  kStuck,  ///< a step would raise chi2, or the normal equations have no solution
};

struct GaussNewtonSummary {
  GaussNewtonEnd end = GaussNewtonEnd::kTooManySteps;
  int steps = 0;
};

/// Moves poses of six degrees of freedom towards the minimum by steps d of T <- T Exp(d), where
/// sum_e w_e J_e^T I_e J_e d = -sum_e w_e J_e^T I_e e, until a step reduces chi2 by less than its
/// share `options.tolerance`. A step that would raise it is not taken.
GaussNewtonSummary GaussNewton(const PoseGraphProblem& problem, const PoseGraphOptions& options,
                               std::vector<Pose>& poses);

}  // namespace sslcd
