// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "sslcd/core/cue.h"
#include "sslcd/core/export.h"
#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// The mean appearance of an object from one direction.
struct AppearanceView {
  double viewpoint_rad = 0;   ///< bearing of the camera in the object frame; 0: from the front
  int count = 1;              ///< number of sightings
  std::vector<float> vector;  ///< mean of the unit vectors of the sightings
};

/// An object of a layout: a vertex of the paper's G = (V, E) (IV-A). Coordinates are
/// gravity-aligned: x forward, y left, z up (the axes of GravityFrame), origin anywhere.
struct LayoutObject {
  int id = -1;    ///< landmark id
  int label = 0;  ///< number of the label
  Symmetry symmetry = Symmetry::kNone;
  Vec3 position{0, 0, 0};  ///< centre [m]
  /// height of the centre in the world, which tells storeys apart; NaN: unknown [m]
  double altitude = std::numeric_limits<double>::quiet_NaN();
  /// path length at which the first pass that saw it ended, in a map along a path [m]
  double since_m = -std::numeric_limits<double>::infinity();
  double yaw = 0;      ///< about z; NaN: unknown [rad]
  Vec3 dims{0, 0, 0};  ///< length, width, height [m]; zero: unknown
  /// views of each cue, one per viewing direction; empty: unknown
  PerCue<std::vector<AppearanceView>> appearance;
};

/// A 4-DoF transform: p_to = Rz(yaw) p_from + t, in gravity-aligned axes. [rad, m]
struct YawShift {
  double yaw = 0;
  Vec3 t{0, 0, 0};
};

}  // namespace sslcd
