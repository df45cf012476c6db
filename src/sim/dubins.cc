// SPDX-License-Identifier: BSD-3-Clause
#include "sim/dubins.h"

#include <cmath>
#include <limits>

namespace sslcd::sim {
namespace {

/// Wraps an angle to [0, 2 pi). A tiny negative angle from rounding becomes 0, not a full turn.
double Positive(double angle) {
  angle -= 2 * M_PI * std::floor(angle / (2 * M_PI));
  return angle > 2 * M_PI - 1e-9 ? 0 : angle;
}

// All in the plane (z, x), in which headings turn counter-clockwise.
Vec2 Centre(const Path::Point& at, double side, double radius) {
  return {at.z - side * radius * std::sin(at.heading), at.x + side * radius * std::cos(at.heading)};
}

/// `first`, `last`: 1 turns right, -1 turns left. Empty if the two circles are too close for a line
/// between them.
std::vector<PathPiece> Word(const Path::Point& from, const Path::Point& to, double radius,
                            int first, int last) {
  const Vec2 between = Centre(to, last, radius) - Centre(from, first, radius);
  const double distance = between.norm(), across = first == last ? 0 : 2 * radius;
  if (distance < across) return {};
  const double line = std::sqrt(distance * distance - across * across);
  const double heading =
      distance < 1e-9 ? from.heading
                      : std::atan2(between.y(), between.x()) + first * std::atan2(across, line);
  return {{radius * Positive(first * (heading - from.heading)), first / radius},
          {line, 0},
          {radius * Positive(last * (to.heading - heading)), last / radius}};
}

}  // namespace

double LengthOf(const std::vector<PathPiece>& pieces) {
  double length = 0;
  for (const PathPiece& piece : pieces) length += piece.length_m;
  return length;
}

std::vector<PathPiece> ArcLineArc(const Path::Point& from, const Path::Point& to, double radius_m) {
  std::vector<PathPiece> best;
  double shortest = std::numeric_limits<double>::infinity();
  for (int first : {1, -1}) {
    for (int last : {1, -1}) {
      std::vector<PathPiece> word = Word(from, to, radius_m, first, last);
      if (word.empty() || LengthOf(word) >= shortest) continue;
      shortest = LengthOf(word);
      best = std::move(word);
    }
  }
  return best;
}

}  // namespace sslcd::sim
