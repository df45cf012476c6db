// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sim/path.h"

namespace sslcd::sim {

/// One of the paper's four cases: an outward pass, and a last leg that meets it again at an angle.
struct HalvCase {
  const char* name;
  std::vector<PathPiece> out;
  double meet_m;  ///< path length where the last leg meets the outward pass
  /// length of the last leg before and after the meeting point
  double before_m, after_m;
  /// length that it then follows the outward pass in reverse direction
  double along_m;
  /// range of the change of heading at the meeting point [deg]
  double viewpoint_low, viewpoint_high;
  /// ATE of VINS-Fusion without loops (paper Table II), after Sim(3)
  double ate_m;
};

/// `number` 1 to 4: rectangle, straight out and back, curve, small loop.
const HalvCase& HalvCaseOf(int number);

/// The path of a sequence.
struct HalvCourse {
  Path path;
  double return_m = 0;    ///< path length at the end of the outward pass
  double last_leg_m = 0;  ///< path length at the start of the last leg
  /// change of heading between outward pass and last leg at their meeting point
  double viewpoint_rad = 0;
  std::vector<Path::Point> points;  ///< points of the path, every half metre
};

/// Draws a course of a case with a viewpoint from [low, high] [deg]. Straight pieces are `size`
/// times as long as those of the case.
HalvCourse MakeHalvCourse(const HalvCase& shape, double low_deg, double high_deg, double size,
                          std::uint64_t seed);

}  // namespace sslcd::sim
