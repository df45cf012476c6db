// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "loop/layout_point.h"

namespace sslcd {

/// Counts of pairs of objects by distance and direction. Two maps of one place have the same
/// counts, rotated by their heading, and rows of objects make them peak.
namespace pair_directions {

/// Set by hand, by maps of regular rows and streets (docs/notes, city): nearer
/// objects have no direction, farther ones no common row. [m]
inline constexpr float kNearest = 2.f, kFarthest = 25.f;
inline constexpr float kDistanceBin = 2.f;  // [m]
inline constexpr int kDistances = 13;       ///< distance bins
inline constexpr int kDirections = 72;      ///< direction bins of half a turn, 2.5 degrees each
inline constexpr double kBinRad = 3.14159265358979323846 / kDirections;

using Counts = std::array<std::uint16_t, kDistances * kDirections>;  ///< by distance, direction

/// Bin of a pair, distance * kDirections + direction; -1: the pair does not count. The same for
/// (dx, dy) and (-dx, -dy).
int Bin(float dx, float dy);

/// Bins of the pairs of a local layout.
std::vector<int> BinsOf(const std::vector<LayoutPoint>& points);

/// Headings of the local layout at which its pairs agree most with those of the map, best first:
/// the peaks over yaw of
///   c(yaw) = sum over local pairs (d, a) of map(d, a + yaw)
/// and their reverses, since a direction has no sign. None where no peak stands out: there are no
/// rows, or others.
inline constexpr int kMaxHeadings = 6;
inline constexpr int kHeadings = 2 * kDirections;  ///< bins of a turn
struct Headings {
  std::array<int, kMaxHeadings> bin{};  ///< of kHeadings
  int count = 0;
};
Headings FindHeadings(const std::vector<int>& local, const Counts& map);

/// The yaw of a heading. [rad]
float YawOf(int heading);

}  // namespace pair_directions
}  // namespace sslcd
