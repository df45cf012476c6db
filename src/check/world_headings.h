// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "check/static_objects.h"

namespace sslcd::check {

/// One object in two frames, told by its place.
struct SameObject {
  const Row *before = nullptr, *after = nullptr;
  /// turn of the camera from one frame to the other about its own y axis (down) [rad]
  double camera_turn = 0;
};

/// Pairs of detections that meet within half of the cap, while no second object of the label does.
std::vector<SameObject> SameObjects(const Sequence& sequence, const std::vector<FramePair>& pairs,
                                    double cap_m);

/// The change of an object's heading in the world, from its rotation_y in both frames: 0 for one
/// that stands still. [rad]
double WorldTurn(const SameObject& object, double ry_before, double ry_after);

}  // namespace sslcd::check
