// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sim/path.h"

namespace sslcd::sim {

/// One of the paper's four cases: a way out, and a last leg that meets the way out again at another
/// angle.
struct HalvCase {
  const char* name;
  std::vector<PathPiece> out;
  double meet_m;  ///< where on the way out the last leg meets it
  /// the last leg begins so long before and ends so long after that
  double before_m, after_m;
  /// then it turns into the way out, against its direction, for so long
  double along_m;
  double viewpoint_low, viewpoint_high;  ///< by how much its direction differs there [deg]
  /// of VINS-Fusion without a loop (paper Table II), after Sim(3)
  double ate_m;
};

/// `number` 1 to 4: rectangle, straight out and back, curve, small loop.
const HalvCase& HalvCaseOf(int number);

/// What is driven.
struct HalvCourse {
  Path path;
  double return_m = 0;              ///< here the way out ends
  double last_leg_m = 0;            ///< here the last leg begins
  double viewpoint_rad = 0;         ///< between way out and last leg, where they meet
  std::vector<Path::Point> points;  ///< of the path, every half metre
};

/// A course of a case. The viewpoint is drawn from [low, high] [deg]; straight pieces are `size`
/// times as long as the case's.
HalvCourse MakeHalvCourse(const HalvCase& shape, double low_deg, double high_deg, double size,
                          std::uint64_t seed);

}  // namespace sslcd::sim
