// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "loop/object_graph.h"

namespace sslcd {

/// w of the paper's IV-B: the weights of the K edges of a vertex, sorted (ascending) and normalised
/// so that they sum to one. None: the vertex has fewer than K neighbours, or all of them are at its
/// own position.
std::optional<Eigen::VectorXd> LayoutVector(const ObjectGraph& graph, int id, int k);

/// Eq. 10: d_f = |w_L - w_G| of vectors of the same length. In [0, sqrt(2)).
double LayoutDifference(const Eigen::VectorXd& local, const Eigen::VectorXd& global);

}  // namespace sslcd
