// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bundle/object_ba.h"
#include "map/map_state.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {

/// The sliding-window bundle adjustment that runs with every keyframe (paper III-C): cameras of the
/// last keyframes, the objects they see, and a prior for what has left the window. Starts again
/// from the newest keyframe when anything else has moved its frames or rewritten landmarks.
/// Copyable.
class SlidingWindow {
 public:
  SlidingWindow(const WindowOptions& options, const BaOptions& ba, const DetectionNoise& noise)
      : options_(options), ba_(ba), noise_(noise) {}

  /// Whether a camera at this pose of the odometry, which comes after all frames, is a keyframe.
  bool IsKeyframe(const FrameStore& frames, const Pose& T_odom_cam) const;

  /// The newest frame is a keyframe: optimises the window, unless `options.enabled` is false, moves
  /// its frames and objects, and the log scale of the odometry. `expected_log_scale`: the mean of
  /// its prior.
  BaSummary AddKeyframe(MapState& state, double& log_scale, double expected_log_scale);

 private:
  BaProblem Problem(const MapState& state, double log_scale, double expected_log_scale) const;
  void AddObjects(const MapState& state, BaProblem& problem) const;
  void Slide(MapState& state, const BaProblem& problem);

  WindowOptions options_;
  BaOptions ba_;
  DetectionNoise noise_;
  std::vector<int> keyframes_;  // in the window: indices of frames
  BaPrior prior_;
  // when the prior was computed
  FrameStore::Revision revision_ = 0;
  int known_frames_ = 0, map_rewrites_ = 0;
};

/// `T_odom_cam` of a frame after `from`, carried over to the world. `log_scale`: of metres per
/// odometry metre.
Pose PredictPose(const FrameRecord& from, const Pose& T_odom_cam, double log_scale);

}  // namespace sslcd
