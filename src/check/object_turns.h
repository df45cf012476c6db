// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "check/sequence.h"

namespace sslcd::check {

/// A turn of the camera from one frame to the next, as its objects show it: an object at depth z
/// moves by -turn * z along x while the camera moves along z.
struct ObjectTurn {
  int frame = 0;        ///< the second one
  double turn_rad = 0;  ///< about the camera's y axis (down): the median over the objects
  int objects = 0;
};

/// One for each frame in which two objects or more are those of the frame before: of one label,
/// nearest to each other and with no other one near. The odometry enters by the length of its step
/// alone. Objects at most 25 m away; O(n^2) in the objects of a frame.
std::vector<ObjectTurn> TurnsOfObjects(const Sequence& sequence, double cap_m);

/// The odometry's turn to a frame from the one before.
double OdometryTurn(const std::vector<Pose>& poses, int frame);

}  // namespace sslcd::check
