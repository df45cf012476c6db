// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"

namespace SSLCD_EXPORT sslcd {

/// The noise of odometry: a random walk whose variance grows with the distance d between two
/// frames, plus a share of each rotation angle a: var = floor^2 + walk^2 d (+ turn^2 a^2 for
/// rotations). Height has a separate walk, because slowly pitching cameras and uneven roads
/// increase its drift.
struct OdometryNoise {
  double translation_floor_m = 0.003;  ///< per axis
  double translation_walk = 0.01;      ///< horizontal [m per sqrt(m)]
  double vertical_walk = 0.01;         ///< [m per sqrt(m)]
  double rotation_floor_rad = 2e-4;    ///< per axis
  double rotation_walk = 5e-4;         ///< [rad per sqrt(m)]
  double rotation_turn = 2e-3;         ///< [rad per rad turned]
  /// standard deviation of the log scale, with heavy tails; 0 fixes the scale at one
  double scale_prior = 0.01;
};
void DescribeFields(FieldVisitor& visitor, OdometryNoise& noise);

}  // namespace sslcd
