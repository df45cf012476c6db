// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "retrieval/site_point.h"

namespace sslcd {

/// Number of neighbours whose constellations an object proposes. Chosen on generated sites
/// (docs/scale.md).
inline constexpr int kNeighbours = 7;

/// Indices of the nearest objects, nearest first; -1: none.
using Neighbours = std::array<int, kNeighbours>;

/// The nearest neighbours of every point, none farther than 60 m. O(n log n)
std::vector<Neighbours> NearestNeighbours(const std::vector<SitePoint>& points);

}  // namespace sslcd
