// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/pose.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Aligns drifting odometry with gravity. Without gravity measurements roll and pitch drift, by 15
/// degrees and more over kilometres of LiDAR odometry, and layouts of tilted maps cannot be
/// compared from above. A camera on the ground is upright on average, up to the slope of the
/// ground. If the mean tilt over a path segment exceeds any slope, the excess is drift and is
/// corrected gradually.
class GravityAligner {
 public:
  GravityAligner(const GravityFrame& gravity, const LevelOptions& options)
      : gravity_(gravity), options_(options) {}

  /// Aligns the next odometry pose. The first camera defines its up direction, since it is upright
  /// up to a slope.
  Pose Align(const Pose& T_odom_cam);

 private:
  GravityFrame gravity_;
  LevelOptions options_;
  std::optional<Pose> raw_;  // the last input pose
  Pose level_;               // the last output pose
  Vec3 up_in_cam_{0, 0, 0};
  Vec3 mean_up_{0, 0,
                0};  // up direction of the camera in the world, averaged over the last segment
};

}  // namespace sslcd
