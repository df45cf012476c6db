// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// Poses and relative measurements between them.
struct PoseGraph {
  struct Vertex {
    int id = 0;
    Pose T_world_vertex;  ///< initial value, later the estimate
    bool fixed = false;   ///< keeps its pose
  };
  struct Edge {
    int from = 0, to = 0;  ///< vertex ids
    Pose T_from_to;        ///< measurement
    /// Information of Log(T_from_to^-1 T_world_from^-1 T_world_to), order [translation, rotation].
    Eigen::Matrix<double, 6, 6, Eigen::DontAlign> information =
        Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Identity();
    /// a loop candidate that a robust solve may refuse; all other edges are trusted
    bool loop = false;
  };
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
};

/// T_world_vertex of all vertices, in order.
inline std::vector<Pose> PosesOf(const PoseGraph& graph) {
  std::vector<Pose> poses;
  for (const auto& vertex : graph.vertices) poses.push_back(vertex.T_world_vertex);
  return poses;
}

}  // namespace sslcd
