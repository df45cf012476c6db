// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "change/sightings.h"

namespace sslcd {

/// A place where an object has stood: landmarks that cannot be two objects at one time.
struct Place {
  std::vector<int> landmarks;  ///< indices of HistoryWorld::objects, most sightings first
  // of the first landmark
  std::string label;
  Symmetry symmetry = Symmetry::kNone;
  Pose T_world_object;
  Vec3 dims{0, 0, 0};
  int map = -1;
  std::vector<SessionLooks> sessions;  ///< of all landmarks
};

/// Groups landmarks to places. Two are one place if they were not seen together, have about the
/// same size, and overlap by half: a car that was replaced by another one in the same space is one
/// place, and so is an object with a landmark of its own in each session. Farther apart they are
/// one if the detector's noise explains the distance and they look the same. Each place has at
/// least one confirmed landmark. Driving objects have none. O(n log n) for landmarks of bounded
/// density.
std::vector<Place> FindPlaces(const Sightings& sightings);

}  // namespace sslcd
