// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/halv_course.h"
#include "sim/slots.h"

namespace sslcd::sim {

/// Vehicles of a real lot. The file is a JSON list of {"x","y","z","qx","qy","qz","w"}: positions
/// in metres, z up, and the quaternion's yaw ("qw" for "w" is taken, too; roll, pitch and z do not
/// count, the world is flat). "label" is optional: Car, Van or Truck. Which of a vehicle's axes is
/// its length is not told, so it is the one along which fewer of them overlap. Vehicles that still
/// overlap an earlier one are left out. In the axes of Slot: x right, z forward. Throws
/// Error(kBadInput) with file, line and key.
struct LayoutFile {
  std::vector<Slot> slots;
  int doubles = 0;  ///< left out
};
LayoutFile ReadLayout(const std::string& path);

/// Moves the vehicles to where the course fits best among them: the way out and the last leg see
/// many in common, few are in the way. Those are removed. Throws Error(kUsage) where the course
/// would leave the lot.
struct PlacedLayout {
  std::vector<Slot> slots;
  int in_the_way = 0;  ///< removed
};
PlacedLayout PlaceLayout(const std::vector<Slot>& slots, const HalvCourse& course);

}  // namespace sslcd::sim
