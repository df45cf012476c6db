// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "ground/ground_frame.h"
#include "sslcd/ground/ground_plane.h"
#include "stereo/disparity.h"

namespace sslcd {

/// One point of the contour of an object: the disparity of its lower body in one column, like a
/// point of a laser scan.
struct ScanPoint {
  double u = 0, v = 0;   ///< mean of its pixels [px]
  double disparity = 0;  ///< median of its pixels [px]
};

struct ScanRules {
  /// range of heights above the ground: below glass, above the shadow
  double low_m = 0, high_m = 0;
  double depth_m = 0;      ///< largest depth of the visible side of an object
  double columns = 40;     ///< largest number of points; set by hand
  std::size_t fewest = 4;  ///< smallest number of points; set by hand
};

/// A nearer object, which may occlude the object.
struct Nearer {
  Box2d box;
  std::vector<ScanPoint> scan;         ///< by `u`; empty: unknown
  std::optional<Footprint> footprint;  ///< none: unknown
};

/// Extracts the candidate scans of an object. Drops the pixels of `nearer` objects: those at the
/// depth of their scans, or in the box of one without a scan. Then drops background and other
/// occluders: a candidate has points within `depth_m` of each other. The first candidate is the
/// depth interval with most pixels, the second one has most of the rest; each has at least `fewest`
/// points.
std::vector<std::vector<ScanPoint>> ScanObject(const DisparityPatch& patch, const Box2d& box,
                                               const std::vector<Nearer>& nearer,
                                               const StereoCamera& camera,
                                               const GroundFrame& ground, const ScanRules& rules);

}  // namespace sslcd
