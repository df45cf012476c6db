// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd::sim {

/// What one object covers of the horizon: an interval of bearings (atan2(x, z), right is positive)
/// at some range.
struct Silhouette {
  double left = 0, right = 0;  ///< [rad]
  double range = 0;            ///< of the centre [m]
};

/// Of a cuboid whose corners are all in front of the camera.
Silhouette SilhouetteOf(const Pose& T_cam_object, const Vec3& dims);

/// Fraction of `target` that no nearer one hides, in [0, 1]. Heights are not looked at.
double VisibleFraction(const Silhouette& target, const std::vector<Silhouette>& all);

}  // namespace sslcd::sim
