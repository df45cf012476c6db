// SPDX-License-Identifier: BSD-3-Clause
// VINS-Fusion's rig and keyframes in sslcd's terms. Knows neither ROS nor VINS.
#pragma once

#include <optional>
#include <vector>

#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::vins {

/// What VINS's configuration says of the body and its first camera.
struct Rig {
  bool imu = false;              ///< `imu: 1`
  Pose T_body_cam;               ///< `body_T_cam0`
  std::optional<Camera> camera;  ///< none: not a pinhole without distortion
};

/// A keyframe of VINS's pose graph.
struct Keyframe {
  int index = 0;              ///< KeyFrame::index
  int sequence = 0;           ///< KeyFrame::sequence
  Pose T_odom_body;           ///< the estimator's pose, never one that a pose graph has moved
  Pose T_body_cam;            ///< extrinsics at that time (VINS may estimate them)
  bool has_own_loop = false;  ///< VINS has closed a loop here itself
};

/// Up in the odometry's world. VINS knows gravity only with an IMU: z is up then. Without, the
/// world has the axes of the first body, and up is the first camera's -y.
Vec3 UpAxis(const Rig& rig);

/// The recommended options. Without an IMU sslcd levels the odometry; with one, VINS's gravity is
/// better.
Options MapperOptions(const Rig& rig);

MapperContext ContextOf(const Rig& rig, const LabelTable& labels);

/// The mapper's frame of a keyframe. It has VINS's index, so that loops name VINS's keyframes even
/// where VINS has skipped or dropped some.
Frame MakeFrame(const Keyframe& keyframe, double stamp, std::vector<Detection> detections);

}  // namespace sslcd::vins
