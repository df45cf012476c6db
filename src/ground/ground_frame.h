// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "sslcd/ground/ground_plane.h"

namespace sslcd {

/// Axes on the ground below the left camera: x to the right, y up, z ahead.
struct GroundFrame {
  Eigen::Matrix3d axes;  ///< columns: right, up, ahead in the camera
  double height_m;       ///< height of the camera

  explicit GroundFrame(const GroundPlane& plane) : height_m(plane.height_m) {
    const Vec3 ahead = (Vec3::UnitZ() - plane.up.z() * plane.up).normalized();
    axes << ahead.cross(plane.up), plane.up, ahead;
  }
  Vec3 FromCamera(const Vec3& point) const {
    return axes.transpose() * point + Vec3(0, height_m, 0);
  }
  Vec3 ToCamera(const Vec3& point) const { return axes * (point - Vec3(0, height_m, 0)); }
};

/// The footprint of an object on the ground, in the GroundFrame. Yaw counts from right to ahead.
struct Footprint {
  double x = 0, z = 0, yaw = 0, length = 0, width = 0;

  /// Whether the point is inside, or outside by less than `margin`.
  bool Contains(double at_x, double at_z, double margin) const {
    const double c = std::cos(yaw), s = std::sin(yaw), dx = at_x - x, dz = at_z - z;
    return std::abs(c * dx + s * dz) <= 0.5 * length + margin &&
           std::abs(-s * dx + c * dz) <= 0.5 * width + margin;
  }
};

}  // namespace sslcd
