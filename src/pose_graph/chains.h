// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {

/// A condensed graph with one edge per chain of trusted edges. It keeps the vertices of loops,
/// fixed vertices and junctions, so the cost of a solve depends on the number of loops instead of
/// the length of the path.
/// The edge of a chain has the composed measurement and the propagated covariance; to first order a
/// solve gives the kept vertices the same poses as the full graph. All loop edges are kept in order
/// and come first.
class CondensedGraph {
 public:
  /// `ends` comes from IndexPoseGraph(graph), which must have found no problem. Chains start and
  /// end at kept vertices. Each component without one keeps its first vertex.
  CondensedGraph(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends);

  PoseGraph& graph() { return condensed_; }

  /// Sets all vertices of `full` (the original graph): kept ones from graph(), those of a chain by
  /// distributing the chain's error by covariance, dangling ones rigidly with the vertex they are
  /// attached to.
  void Expand(PoseGraph& full) const;

 private:
  struct Link {
    int vertex = 0;                          ///< end of the link in the full graph
    Pose T_before_here;                      ///< measured
    Eigen::Matrix<double, 6, 6> covariance;  ///< covariance of the measurement, right perturbation
  };
  struct Chain {
    int start = 0;            ///< vertex of the full graph
    std::vector<Link> links;  ///< the last one ends at a kept vertex or is dangling
    bool dangling = false;
  };
  // per vertex: trusted edge, other end
  using Neighbours = std::vector<std::vector<std::pair<int, int>>>;

  Chain Follow(int start, int edge, const PoseGraph& full,
               const std::vector<std::pair<int, int>>& ends, const Neighbours& neighbours,
               std::vector<bool>& used) const;

  std::vector<int> kept_;  // condensed vertex of each vertex of the full graph, or -1
  std::vector<Chain> chains_;
  PoseGraph condensed_;
};

/// SolvePoseGraph from the given poses, on the condensed graph: the same poses to first order.
/// `loop_weights`: of each loop, in the order of the edges.
PoseGraphSummary SolveCondensed(PoseGraph& graph, const PoseGraphOptions& options,
                                const std::vector<double>& loop_weights);

}  // namespace sslcd
