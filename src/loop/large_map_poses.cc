// SPDX-License-Identifier: BSD-3-Clause
#include "loop/large_map_poses.h"

#include <algorithm>

#include "loop/pose_ranking.h"
#include "loop/raster_search.h"
#include "loop/triangle_poses.h"

namespace sslcd {
namespace {

// Number of peaks of the correlation to rank, per pose that is kept, and at least. Set by hand: of
// 120 places in car parks and streets with 95 000 objects the peak of the right pose was among the
// best 2000 in 115, and 5000 bring one more.
constexpr std::size_t kPeaksPerKept = 25, kFewestPeaks = 500;
// Number of poses by triangles to rank in tiles that have been searched: rows of few objects may
// suggest wrong headings. Set by hand.
constexpr std::size_t kMostInRows = 300;
// Number of local objects that propose poses, those next to the centre. Bounds the time.
constexpr std::size_t kMostLocal = 200;

}  // namespace

CoarseSearch LargeMapPoses(std::vector<LayoutPoint> points, const LayoutIndex& index,
                           const PoseSearchOptions& options) {
  if (points.size() > kMostLocal) {
    std::stable_sort(points.begin(), points.end(), [](const LayoutPoint& a, const LayoutPoint& b) {
      return a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
    });
    points.resize(kMostLocal);
  }
  const std::size_t keep = options.refine;
  RasterPoses found = SearchRasters(points, index, std::max(kFewestPeaks, kPeaksPerKept * keep));
  std::vector<CoarsePose>& poses = found.poses;
  std::vector<CoarsePose> in_rows;
  for (const CoarsePose& pose : TrianglePoses(points, index))
    (found.HasSearched(*index.tiles(), pose) ? in_rows : poses).push_back(pose);
  KeepBest(kMostInRows, in_rows);
  poses.insert(poses.end(), in_rows.begin(), in_rows.end());
  return RankPoses(std::move(poses), points, index, options);
}

}  // namespace sslcd
