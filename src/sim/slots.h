// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/path.h"

namespace sslcd::sim {

/// A place for a vehicle: its centre and heading (from +z towards +x).
struct Slot {
  double x = 0, z = 0, heading = 0;
  std::string label;  ///< empty: any vehicle
};

/// The pose of a vehicle in the slot, `y_m` down. [T_world_object]
Pose PoseOf(const Slot& slot, double y_m);

/// Whether a path along the points keeps about a metre of distance from a vehicle in the slot.
bool IsClear(const Slot& slot, const std::vector<Path::Point>& points);

/// Whether vehicles of usual size in the two slots would touch.
bool Overlap(const Slot& a, const Slot& b);

/// A regular car park around the points: aisles along z, one of them at x = 0, with stalls across
/// on both sides. Leaves out stalls on the path.
std::vector<Slot> LotSlots(const std::vector<Path::Point>& points);

/// Parking spaces along both kerbs of the path. Leaves out those on the path.
std::vector<Slot> StreetSlots(const Path& path, const std::vector<Path::Point>& points);

/// Places for poles (label "Pole") and trees ("Tree") in such a car park and along such a street.
std::vector<Slot> LotMarks(const std::vector<Path::Point>& points);
std::vector<Slot> StreetMarks(const Path& path, const std::vector<Path::Point>& points);

}  // namespace sslcd::sim
