// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/coarse_poses.h"
#include "loop/layout_index.h"

namespace sslcd {

/// Poses from aligning triangles of the local map with equal ones of the global map. `score` is the
/// number of votes: poses near it. If there are many, returns those with most votes. `points` are
/// the local ones with the centre at the origin. The number of poses is bounded for any size of the
/// map.
std::vector<CoarsePose> TrianglePoses(const std::vector<LayoutPoint>& points,
                                      const LayoutIndex& index);

}  // namespace sslcd
