// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// A graph's edges by position of their vertices in `graph.vertices`.
struct PoseGraphIndex {
  std::vector<std::pair<int, int>> ends;  ///< from, to; one per edge
  std::string trouble;                    ///< the problem of the graph; empty: the graph is valid
};

/// Finds the vertices of each edge and checks the graph: ids are unique and exist, numbers are
/// finite, information is positive definite.
PoseGraphIndex IndexPoseGraph(const PoseGraph& graph);

/// Number of each vertex's connected component, counted from 0 in vertex order. Edges with use[i]
/// == false do not connect; an empty `use` means all.
std::vector<int> Components(int vertices, const std::vector<std::pair<int, int>>& ends,
                            const std::vector<bool>& use = {});

}  // namespace sslcd
