// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/coarse_poses.h"

namespace sslcd {

/// The best distinct poses in a map with MapTiles, `options.refine` at most, best first. Where the
/// map has rows, all poses along them are searched (SearchRasters); elsewhere, and where
/// they have most votes, triangles of neighbours propose poses (TrianglePoses); rows have them by
/// the ten thousand. RankPoses
/// ranks both. `points` are the local ones with the centre at the origin.
CoarseSearch LargeMapPoses(std::vector<LayoutPoint> points, const LayoutIndex& index,
                           const PoseSearchOptions& options);

}  // namespace sslcd
