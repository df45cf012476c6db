// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// Initial values for nonlinear graphs that need no initial values themselves: rotations minimise
/// sum k |R_j - R_i R_ij|_F^2 over all 3x3 matrices and are then projected to rotations (chordal
/// relaxation: Carlone et al., "Initialization techniques for 3D SLAM", ICRA 2015); with these,
/// translations minimise sum m |t_j - t_i - R_i t_ij|^2. k and m are the means of the information's
/// diagonal, times the edge's weight. Both problems are linear with one sparse factorisation each.
/// `anchored` vertices are fixed; each connected component must have one. None: the factorisation
/// failed.
std::optional<std::vector<Pose>> ChordalStart(const PoseGraph& graph,
                                              const std::vector<std::pair<int, int>>& ends,
                                              const std::vector<double>& weights,
                                              const std::vector<bool>& anchored);

}  // namespace sslcd
