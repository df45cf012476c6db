// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/coarse_poses.h"
#include "loop/layout_index.h"

namespace sslcd {

/// Poses that triangles of the local map propose, laid on those of equal sides in the global one,
/// without a score: if there are many, those that most triangles agree on. `points` are the local
/// ones, their centre in the origin. The number of poses is bounded whatever the map's size.
std::vector<CoarsePose> TrianglePoses(const std::vector<LayoutPoint>& points,
                                      const LayoutIndex& index);

}  // namespace sslcd
