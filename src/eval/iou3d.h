// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/pose.h"

namespace sslcd {

/// An upright box in the axes [forward left up] of some GravityFrame.
struct Cuboid {
  Vec3 centre{0, 0, 0};  ///< [m]
  double yaw = 0;        ///< of its length axis, from forward towards left [rad]
  Vec3 dims{0, 0, 0};    ///< length, width, height [m]

  double Volume() const { return dims.prod(); }
};

/// The box of an object in a frame with the given vertical; roll and pitch are dropped.
Cuboid ToCuboid(const Pose& T_world_object, const Vec3& dims, const GravityFrame& gravity);

/// Distance of the centres in the horizontal plane. [m]
double HorizontalDistance(const Cuboid& a, const Cuboid& b);

/// Area common to the two footprints, exact up to rounding. [m^2]
double FootprintIntersection(const Cuboid& a, const Cuboid& b);

/// Intersection over union of the two volumes, in [0, 1], exact up to rounding. 0 where one is
/// empty (a dimension that is not positive). Both must be in the same axes.
double Iou3d(const Cuboid& a, const Cuboid& b);

}  // namespace sslcd
