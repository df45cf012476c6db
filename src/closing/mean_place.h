// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "closing/pass_map.h"

namespace sslcd {

/// A range of the path and the smallest number of sightings.
struct PathRange {
  double from_m = 0, to_m = 0;
  int min_sightings = 1;
};

/// The mean place of an object over its sightings.
struct MeanSighting {
  UprightPose pose;     ///< in the world
  double height_m = 0;  ///< height over the camera nearest to it
  double seen_m = 0;    ///< mean path length of the sightings
};

/// Information-weighted mean place over the sightings of a pass in a range of the path. None: too
/// few sightings.
std::optional<MeanSighting> MeanPlace(const PassObject& pass, const MapState& state,
                                      const DetectionNoise& noise, const PathRange& range);

}  // namespace sslcd
