// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chain, O(n log n)). Empty
/// without points. Points on an edge are not corners.
std::vector<Vec2> ConvexHull(std::vector<Vec2> points);

}  // namespace sslcd
