// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "closing/loop_graph.h"
#include "map/map_state.h"
#include "odometry/odometry_noise.h"
#include "pose_graph/relative_covariance.h"

namespace sslcd {

/// How far odometry and the accepted loops leave the relative pose of two frames open. Computed
/// from the pose graph of both with a vertex every 20 m of path, on more than 2 km every hundredth
/// of it. Where nothing joins two parts, a lost step is all there is. `state` has to stay.
class TrajectoryUncertainty {
 public:
  using Mat6 = RelativeCovariances::Mat6;
  using Vec6 = RelativeCovariances::Vec6;

  TrajectoryUncertainty(const MapState& state, const std::vector<LoopEdge>& loops,
                        const OdometryModel& odometry);

  /// Covariance of the motion [translation, rotation] of the world around the frame `to` relative
  /// to the world around `from`, each at its nearest vertex.
  const Mat6& Between(int from, int to) const;

  /// Variance of the part of this motion along `direction`; less work than Between().
  double Variance(int from, int to, const Vec6& direction) const;

  /// Whether odometry that was never lost, and loops, lead from one frame to the other.
  bool Joined(int from, int to) const;

  /// The frames of the vertices, by index.
  const std::vector<int>& frames() const { return frames_; }

 private:
  int NearestVertex(int frame) const;
  Mat6 Walk(int from, int to) const;
  Mat6 BetweenVertices(int from, int to) const;
  void Solve(std::vector<DifferenceMeasurement> measured);

  const MapState& state_;
  OdometryModel odometry_;
  std::vector<int> frames_;
  std::vector<double> path_of_all_;  // of all frames
  // of the vertices: the same number where something leads from one to another
  std::vector<int> part_;
  std::map<int, Pose> centre_;  // of the parts, about which their covariances are solved
  std::optional<RelativeCovariances> covariances_;
  mutable std::map<std::pair<int, int>, Mat6> known_;
};

}  // namespace sslcd
