// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace sslcd {

struct KMeansOptions {
  int clusters = 6;
  /// largest number of iterations of Lloyd's algorithm; it stops if no point changes its cluster
  int iterations = 10;
  std::uint64_t seed = 1;
};

/// Points are columns.
struct KMeansResult {
  /// up to `clusters` centres, fewer if there are fewer different points; no cluster is empty
  Eigen::Matrix3Xf centres;
  std::vector<int> sizes;  ///< points per centre
  double compactness = 0;  ///< sum of squared distances of the points to their centres
};

/// K-means with the k-means++ seeding of Arthur and Vassilvitskii (2007), in its greedy form: each
/// new centre is the best of a few draws. Deterministic for a seed. Points must be finite. Without
/// points there are no centres.
KMeansResult KMeans(const Eigen::Matrix3Xf& points, const KMeansOptions& options);

}  // namespace sslcd
