// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bundle/object_ba.h"
#include "map/map_state.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {

/// The sliding-window bundle adjustment at every keyframe (paper III-C): the cameras of the last
/// keyframes, their objects, and a marginal prior of the states that have left the window. Restarts
/// from the newest keyframe if another step has moved its frames or rewritten landmarks. Copyable.
class SlidingWindow {
 public:
  SlidingWindow(const WindowOptions& options, const BaOptions& ba, const DetectionNoise& noise)
      : options_(options), ba_(ba), noise_(noise) {}

  /// Whether the next camera, at this odometry pose, is a keyframe.
  bool IsKeyframe(const FrameStore& frames, const Pose& T_odom_cam) const;

  /// Adds the newest frame as a keyframe. Unless `options.enabled` is false, optimises the window
  /// and moves its frames, its objects and the log scale of the odometry, whose prior has the mean
  /// `expected_log_scale`.
  BaSummary AddKeyframe(MapState& state, double& log_scale, double expected_log_scale);

 private:
  BaProblem Problem(const MapState& state, double log_scale, double expected_log_scale) const;
  void AddObjects(const MapState& state, BaProblem& problem) const;
  void Slide(MapState& state, const BaProblem& problem);

  WindowOptions options_;
  BaOptions ba_;
  DetectionNoise noise_;
  std::vector<int> keyframes_;  // keyframes of the window, as indices of frames
  BaPrior prior_;
  // when the prior was computed
  FrameStore::Revision revision_ = 0;
  int known_frames_ = 0, map_rewrites_ = 0;
};

/// T_world_cam of a frame after `from` with the pose `T_odom_cam`. `log_scale` is the logarithm of
/// metres per odometry metre.
Pose PredictPose(const FrameRecord& from, const Pose& T_odom_cam, double log_scale);

}  // namespace sslcd
