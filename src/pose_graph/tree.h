// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// The trusted edges' own geometry: a spanning tree over them, breadth first from the first vertex
/// of each part, with the poses that it gives and how uncertain these are. Loops have no part in
/// it, so false ones cannot spoil it.
class TrustedTree {
 public:
  /// `ends` as of IndexPoseGraph(graph), which must have found nothing wrong. Roots keep their
  /// pose.
  TrustedTree(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends);

  const std::vector<Pose>& poses() const { return poses_; }  ///< T_world_vertex

  /// How well edge e = from -> to agrees with the tree: e^T (C_edge + C_way)^-1 e with the
  /// covariance of the way from one end to the other. Grows with what odometry alone cannot
  /// explain. 0 where the tree does not join the ends.
  double Disagreement(const PoseGraph::Edge& edge, int from, int to) const;

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  std::vector<int> parent_, depth_;  // parent of a root: -1
  std::vector<Pose> poses_;
  // from the root; perturbation on the left, where covariances of steps add up
  std::vector<Matrix6> covariance_;
};

}  // namespace sslcd
