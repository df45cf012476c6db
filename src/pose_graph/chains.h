// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// A graph whose chains of trusted edges have become one edge each: what is left are the vertices
/// that loops touch, fixed vertices and crossings, so a solve costs by the number of loops and not
/// by the length of the path.
///
/// An edge for a chain has the composed measurement and the propagated covariance; to first order a
/// solve gives the kept vertices the same poses as the whole graph would. Loop edges are all kept,
/// in order, and come first.
class CondensedGraph {
 public:
  /// `ends` as of IndexPoseGraph(graph), which must have found nothing wrong. Chains start and end
  /// at kept vertices; each part of the graph that has none of these keeps its first vertex.
  CondensedGraph(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends);

  PoseGraph& graph() { return condensed_; }

  /// Sets all vertices of `full` (the graph given before): kept ones as they are in graph(), those
  /// of a chain in between by sharing the chain's misfit by covariance, dangling ones rigidly with
  /// what they hang on.
  void Expand(PoseGraph& full) const;

 private:
  struct Link {
    int vertex = 0;                          ///< in the full graph; where the link leads
    Pose T_before_here;                      ///< measured
    Eigen::Matrix<double, 6, 6> covariance;  ///< of the measurement, tangent space on the right
  };
  struct Chain {
    int start = 0;            ///< vertex of the full graph
    std::vector<Link> links;  ///< the last one leads to a kept vertex, or to a dangling end
    bool dangling = false;
  };
  // per vertex: trusted edge, other end
  using Neighbours = std::vector<std::vector<std::pair<int, int>>>;

  Chain Follow(int start, int edge, const PoseGraph& full,
               const std::vector<std::pair<int, int>>& ends, const Neighbours& neighbours,
               std::vector<bool>& used) const;

  std::vector<int> kept_;  // vertex of the full graph -> of the condensed one, or -1
  std::vector<Chain> chains_;
  PoseGraph condensed_;
};

}  // namespace sslcd
