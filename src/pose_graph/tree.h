// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// The geometry of the trusted edges: a spanning tree over them, breadth first from the first
/// vertex of each component, with poses and covariances. It does not depend on loops, so false ones
/// cannot distort it.
class TrustedTree {
 public:
  /// `ends` comes from IndexPoseGraph(graph), which must have found no problem. Roots keep their
  /// pose.
  TrustedTree(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends);

  const std::vector<Pose>& poses() const { return poses_; }  ///< T_world_vertex

  /// The chi2 of edge e = from -> to against the tree: e^T (C_edge + C_path)^-1 e with the
  /// covariance of the path between its ends. A large value means that odometry does not explain
  /// the edge. 0 if the tree does not connect the ends.
  double Disagreement(const PoseGraph::Edge& edge, int from, int to) const;

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  std::vector<int> parent_, depth_;  // parent of a root: -1
  std::vector<Pose> poses_;
  // relative to the root; left perturbation, for which covariances of steps add up
  std::vector<Matrix6> covariance_;
};

}  // namespace sslcd
