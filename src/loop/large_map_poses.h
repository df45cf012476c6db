// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/coarse_poses.h"

namespace sslcd {

/// The best distinct poses in a map with MapTiles, `options.refine` at most, best first. Where the
/// map has rows, all poses at their headings are searched (SearchRasters). Elsewhere triangles of
/// neighbours propose poses (TrianglePoses). A triangle of a row has tens of thousands of twins, so
/// in rows only those with most votes count. RankPoses ranks both. `points` are the local ones with
/// the centre at the origin.
CoarseSearch LargeMapPoses(std::vector<LayoutPoint> points, const LayoutIndex& index,
                           const PoseSearchOptions& options);

}  // namespace sslcd
