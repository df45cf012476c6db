// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/halv_course.h"
#include "sim/slots.h"

namespace sslcd::sim {

/// Vehicles of a real lot. The file is a JSON list of {"x","y","z","qx","qy","qz","w"}: positions
/// in metres, z up, and the quaternion's yaw ("qw" for "w" is taken, too; roll, pitch and z do not
/// count, the world is flat). "label" is optional: Car, Van or Truck. The file does not define
/// which axis of a vehicle is its length, so the reader takes the one with fewer overlaps. It
/// leaves out vehicles that still overlap an earlier one. In the axes of Slot: x right, z forward.
/// Throws Error(kBadInput) with file, line and key.
struct LayoutFile {
  std::vector<Slot> slots;
  int doubles = 0;  ///< vehicles that are left out
};
LayoutFile ReadLayout(const std::string& path);

/// Moves the vehicles to the best fit of the course: the outward pass and the last leg see many
/// common vehicles, and few are on the path. Removes the latter. Throws Error(kUsage) if the course
/// would leave the lot.
struct PlacedLayout {
  std::vector<Slot> slots;
  /// removed vehicles on the path vehicles on the path vehicles on the path vehicles on the path
  int in_the_way = 0;
};
PlacedLayout PlaceLayout(const std::vector<Slot>& slots, const HalvCourse& course);

}  // namespace sslcd::sim
