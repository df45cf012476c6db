// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/neighbours.h"

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <cstddef>

namespace sslcd {
namespace {

// Odometry does not hold the shape of more objects than these together. Set by hand. [m]
constexpr float kFarthest = 60;

}  // namespace

std::vector<Neighbours> NearestNeighbours(const std::vector<SitePoint>& points) {
  Neighbours none;
  none.fill(-1);
  std::vector<Neighbours> near(points.size(), none);
  if (points.size() < 2) return near;
  std::vector<float> at;
  at.reserve(2 * points.size());
  for (const SitePoint& point : points) at.insert(at.end(), {point.x, point.y});
  flann::KDTreeSingleIndex<flann::L2_Simple<float>> tree(
      flann::Matrix<float>(at.data(), points.size(), 2));
  tree.buildIndex();
  const std::size_t found = std::min<std::size_t>(kNeighbours + 1, points.size());
  flann::KNNSimpleResultSet<float> results(found);
  std::vector<std::size_t> index(found);
  std::vector<float> squared(found);
  for (std::size_t i = 0; i < points.size(); ++i) {
    results.clear();
    tree.findNeighbors(results, &at[2 * i], flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    results.copy(index.data(), squared.data(), found);
    int count = 0;
    for (std::size_t k = 0; k < found && count < kNeighbours; ++k)
      if (index[k] != i && squared[k] <= kFarthest * kFarthest)
        near[i][count++] = static_cast<int>(index[k]);
  }
  return near;
}

}  // namespace sslcd
