// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd::check {

/// The poses of a body whose axes are not the camera's.
struct BodyAxes {
  const char* name = "";  ///< for people
  Eigen::Matrix3d R_cam_body;
  double agrees = 0;  ///< mean cosine between its motions and the camera's
};

/// Compares the motions of pairs (T_odom_cam, T_world_body) from frame to frame: their direction
/// and their turn. None: they are those of a camera, of nothing that is known, or the camera turns
/// by less than a radian in all.
std::optional<BodyAxes> FindBodyAxes(const std::vector<std::pair<Pose, Pose>>& pairs);

}  // namespace sslcd::check
