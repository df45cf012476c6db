// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/pose.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Keeps drifting odometry upright. Without gravity measurements roll and pitch drift like
/// everything else, by 15 degrees and more over kilometres of LiDAR odometry; a map that is tilted
/// against another one no longer looks like it from above. But a camera on the ground stands
/// upright on average, up to the slope of the ground: where the mean over a stretch of path tilts
/// further than any slope, the excess is drift and is turned back, bit by bit.
class GravityAligner {
 public:
  GravityAligner(const GravityFrame& gravity, const LevelOptions& options)
      : gravity_(gravity), options_(options) {}

  /// The next pose of the odometry, levelled. The first camera tells which of its directions is up:
  /// it stands upright up to a slope, too.
  Pose Align(const Pose& T_odom_cam);

 private:
  GravityFrame gravity_;
  LevelOptions options_;
  std::optional<Pose> raw_;  // the last one as it came in
  Pose level_;               // ... and as it went out
  Vec3 up_in_cam_{0, 0, 0};
  Vec3 mean_up_{0, 0, 0};  // of the camera, in the world, over the last stretch
};

}  // namespace sslcd
