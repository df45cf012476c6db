// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "closing/pass_map.h"

namespace sslcd {

/// Where on the path to look, and how many sightings are asked for.
struct PathRange {
  double from_m = 0, to_m = 0;
  int min_sightings = 1;
};

/// Where sightings put an object, on average.
struct MeanSighting {
  UprightPose pose;     ///< in the world
  double height_m = 0;  ///< over the camera that saw it from nearest
  double seen_m = 0;    ///< on the path
};

/// Information-weighted mean of where the sightings of a pass on a range of the path put an object.
/// None if they are fewer than asked for.
std::optional<MeanSighting> MeanPlace(const PassObject& pass, const MapState& state,
                                      const DetectionNoise& noise, const PathRange& range);

}  // namespace sslcd
