// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/path.h"

namespace sslcd::sim {

/// The shortest path from one pose to another that consists of an arc, a straight line and an arc
/// of radius `radius_m` (Dubins 1957, the four words with a straight line). It always exists,
/// because arcs to the same side do.
std::vector<PathPiece> ArcLineArc(const Path::Point& from, const Path::Point& to, double radius_m);

double LengthOf(const std::vector<PathPiece>& pieces);

}  // namespace sslcd::sim
