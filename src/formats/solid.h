// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// A convex body of length, width and height 1 about the origin, z up. Scaled by the dimensions of
/// an object, it is that object in its own frame.
struct Solid {
  std::vector<Vec3> corners;
  /// corners of each face, counter-clockwise seen from outside
  std::vector<std::vector<int>> faces;
};

Solid UnitBox();

/// A prism with 14 sides, for objects that look the same from all sides.
Solid UnitCylinder();

}  // namespace sslcd
