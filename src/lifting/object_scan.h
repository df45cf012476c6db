// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "ground/ground_frame.h"
#include "sslcd/ground/ground_plane.h"
#include "stereo/disparity.h"

namespace sslcd {

/// The contour of an object, as a laser scanner would see it: the disparity of its lower body,
/// column by column.
struct ScanPoint {
  double u = 0, v = 0;   ///< the middle of the pixels it is made of [px]
  double disparity = 0;  ///< their median [px]
};

struct ScanRules {
  /// heights above the ground that are looked at: below glass, above the shadow
  double low_m = 0, high_m = 0;
  double depth_m = 0;      ///< the visible side of an object spans no more than this
  double columns = 40;     ///< points, at most; set by hand
  std::size_t fewest = 4;  ///< points, at least; set by hand
};

/// What stands nearer, and may hide some of the object.
struct Nearer {
  Box2d box;
  std::vector<ScanPoint> scan;         ///< by `u`; empty: not known
  std::optional<Footprint> footprint;  ///< none: not known
};

/// Without what is not the object: pixels as far away as the scan of a `nearer` object is there, or
/// in its box where it has none; what lies behind, and what else stands in front. Each answer's
/// points lie within `depth_m` of each other: the stretch of depth that has most pixels, then the
/// one that has most of the others; at least `fewest` points in each.
std::vector<std::vector<ScanPoint>> ScanObject(const DisparityPatch& patch, const Box2d& box,
                                               const std::vector<Nearer>& nearer,
                                               const StereoCamera& camera,
                                               const GroundFrame& ground, const ScanRules& rules);

}  // namespace sslcd
