// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "retrieval/neighbours.h"
#include "retrieval/site_point.h"

namespace sslcd {

inline constexpr int kMembers = 5;
inline constexpr int kCoordinates = 2 * (kMembers - 1);

/// An object and four of its nearest neighbours, in a frame of their own: the origin in their
/// centre, x along the principal axis, towards the side with the longer tail. Sorted coordinates do
/// not depend on an order of the objects and change steadily when objects move; those of a mirror
/// image differ. Sums of the coordinates are zero, so the middle one of each axis is left out.
struct Constellation {
  float x = 0, y = 0;            ///< its centre [m]
  float axis_x = 1, axis_y = 0;  ///< direction of its axis, a unit vector
  /// four along the axis, four across it, each ascending [m]
  std::array<float, kCoordinates> coordinates{};
  std::uint32_t labels = 0;  ///< hash of the labels, in any order
};

/// The constellation of five points; none if they have no clear axis.
std::optional<Constellation> MakeConstellation(const std::array<const SitePoint*, kMembers>& five);

/// Calls visit(constellation) for each set of an object and four of its neighbours, once.
template <class Visitor>
void VisitConstellations(const std::vector<SitePoint>& points, const std::vector<Neighbours>& near,
                         Visitor&& visit);

/// Whether `five`, an object and four of its neighbours, is not also proposed by an earlier object.
bool IsFirstToPropose(const std::vector<Neighbours>& near, const std::array<int, kMembers>& five);

template <class Visitor>
void VisitConstellations(const std::vector<SitePoint>& points, const std::vector<Neighbours>& near,
                         Visitor&& visit) {
  std::array<int, kMembers> five{};
  std::array<const SitePoint*, kMembers> at{};
  const auto choose = [&](const auto& self, int member, int from) -> void {
    if (member == kMembers) {
      if (!IsFirstToPropose(near, five)) return;
      for (int i = 0; i < kMembers; ++i) at[i] = &points[five[i]];
      if (const auto one = MakeConstellation(at)) visit(*one);
      return;
    }
    for (int k = from; k < kNeighbours && near[five[0]][k] >= 0; ++k) {
      five[member] = near[five[0]][k];
      self(self, member + 1, k + 1);
    }
  };
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    five[0] = i;
    choose(choose, 1, 0);
  }
}

}  // namespace sslcd
