// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/cue.h"
#include "sslcd/core/export.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// One detected object in one frame: the paper's d_i = {l, b, h, e, T_co} (III-B) and its cuboid.
/// The origin of the object frame is the cuboid's centre: x along its length, y to its left, z up.
struct Detection {
  /// 0-based row in the detections file(s), used as its id in map.json
  int row = -1;
  std::string label;  ///< semantic class of the detector, e.g. "Car"
  double score = 1.;  ///< probability that this is an object, in [0, 1]
  /// pose in the camera frame (KITTI axes: x right, y down, z forward)
  Pose T_cam_object;
  Vec3 dims{0, 0, 0};        ///< length, width, height [m], all > 0
  std::optional<Box2d> box;  ///< 2D box [px]; none: association does not use this cue
  /// vector of each cue with unit length (a colour may have unit sum); empty: none
  PerCue<std::vector<float>> appearance;
};

/// One input frame.
struct Frame {
  int index = 0;     ///< number of the frame in its dataset
  double stamp = 0;  ///< [s]
  Pose T_odom_cam;   ///< odometry, with drift and an error of the scale
  std::vector<Detection> detections;
  std::string image_left, image_right;  ///< paths of the images; empty: none
  /// what the odometry reports of the step from the frame before; none: nothing, and a step that is
  /// much longer than all others is taken for a failure
  std::optional<StepUncertainty> step = std::nullopt;
};

}  // namespace sslcd
