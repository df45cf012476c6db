// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {

enum class GaussNewtonEnd {
  kConverged,
  kTooManySteps,
  kStuck,  ///< a step would raise chi2, or the normal equations have no solution
};

/// Moves the poses that are not `anchored` towards the minimum of chi2 (see Chi2Of()) by steps d
/// of T <- T Exp(d), where sum_e w_e J_e^T I_e J_e d = -sum_e w_e J_e^T I_e e, until a step reduces
/// chi2 by less than its share `options.tolerance`. A step that would raise it is not taken. Adds
/// the steps to `steps`. Poses have six degrees of freedom; every component needs an anchor.
GaussNewtonEnd GaussNewton(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends,
                           const std::vector<double>& weights, const std::vector<bool>& anchored,
                           const PoseGraphOptions& options, std::vector<Pose>& poses, int& steps);

}  // namespace sslcd
