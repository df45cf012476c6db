// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Defines when a path comes back to a place.
struct ReturnOptions {
  double spacing_m = 5;  ///< of the cameras that are compared, along the path
  double radius_m = 10;  ///< a camera is back within this horizontal distance of an old one
  double old_m = 60;     ///< an old camera is at least this path behind
};

/// Two cameras of a path, an old one and a later one, and their horizontal distance.
struct Approach {
  std::size_t query = 0, match = 0;  ///< rows of the trajectory, the later one first
  double distance_m = 0;
  double path_m = 0;  ///< between them
};

/// How often a path comes back to where it was before.
struct OdometryReturns {
  int stretches = 0;                ///< of path, along which each compared camera is back
  std::optional<Approach> nearest;  ///< none: the path is too short
};

/// Compares a path with itself, e.g. that of odometry, to tell whether there can be loops. Drift is
/// not taken into account. O((path / spacing)^2).
OdometryReturns FindReturns(const Trajectory& path, const Vec3& up,
                            const ReturnOptions& options = {});

}  // namespace sslcd
