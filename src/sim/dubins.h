// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/path.h"

namespace sslcd::sim {

/// The shortest way from one place and direction to another that consists of an arc, a straight
/// line and an arc, none tighter than `radius_m` (Dubins 1957, his four words with a straight
/// line). Always exists for turns to the same side.
std::vector<PathPiece> ArcLineArc(const Path::Point& from, const Path::Point& to, double radius_m);

double LengthOf(const std::vector<PathPiece>& pieces);

}  // namespace sslcd::sim
