// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/fields.h"

namespace sslcd {

/// How far the odometry is off: a random walk, so variances grow with the distance d between two
/// frames, and a share of each turn a: var = floor^2 + walk^2 d (+ turn^2 a^2 for rotations).
/// Height has a walk of its own: slowly pitching cameras and uneven roads make it drift further
/// than the way on the ground.
struct OdometryNoise {
  double translation_floor_m = 0.003;
  double translation_walk = 0.01;  ///< horizontal [m per sqrt(m)]
  double vertical_walk = 0.01;     ///< [m per sqrt(m)]
  double rotation_floor_rad = 2e-4;
  double rotation_walk = 5e-4;  ///< [rad per sqrt(m)]
  double rotation_turn = 2e-3;  ///< [rad per rad turned]
  double scale_prior = 0.05;    ///< standard deviation of the log scale; 0 keeps the scale at one
};
void DescribeFields(FieldVisitor& visitor, OdometryNoise& noise);

}  // namespace sslcd
