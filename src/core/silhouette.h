// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// The part of the horizon that one object covers: an interval of bearings (atan2(x, z) in the
/// camera, right is positive) at a range.
struct Silhouette {
  double left = 0, right = 0;  ///< [rad]; behind the camera `right` may be above pi
  double range = 0;            ///< of the centre [m]
};

/// The interval of a cuboid. The camera is outside of it.
Silhouette SilhouetteOf(const Pose& T_cam_object, const Vec3& dims);

/// Share of `target` that no nearer interval hides, in [0, 1]. Ignores heights.
double VisibleFraction(const Silhouette& target, const std::vector<Silhouette>& all);

}  // namespace sslcd
