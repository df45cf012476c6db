// SPDX-License-Identifier: BSD-3-Clause
#include "perception/kmeans.h"

#include <algorithm>
#include <random>

namespace sslcd {
namespace {

using Distances = Eigen::Array<float, 1, Eigen::Dynamic>;

Distances SquaredDistances(const Eigen::Matrix3Xf& points, const Eigen::Vector3f& centre) {
  return (points.colwise() - centre).colwise().squaredNorm().array();
}

/// Index drawn with a probability proportional to `weights`, whose sum is `total` > 0.
Eigen::Index Draw(const Distances& weights, double total, std::mt19937_64& engine) {
  double rest = static_cast<double>(engine() >> 11) * 0x1p-53 * total;
  Eigen::Index last = 0;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0) continue;
    last = i;
    rest -= weights[i];
    if (rest < 0) break;
  }
  return last;
}

Eigen::Matrix3Xf Seed(const Eigen::Matrix3Xf& points, const KMeansOptions& options) {
  constexpr int kDraws = 4;  // 2 + log(K), as in the paper
  std::mt19937_64 engine(options.seed);
  Eigen::Matrix3Xf centres(3, std::max(options.clusters, 1));
  centres.col(0) =
      points.col(static_cast<Eigen::Index>(engine() % static_cast<std::uint64_t>(points.cols())));
  Distances nearest = SquaredDistances(points, centres.col(0));
  for (Eigen::Index k = 1; k < centres.cols(); ++k) {
    const double total = nearest.cast<double>().sum();
    if (!(total > 0)) return centres.leftCols(k);  // every point is a centre
    Distances best;
    for (int draw = 0; draw < kDraws; ++draw) {
      const Eigen::Vector3f candidate = points.col(Draw(nearest, total, engine));
      const Distances distances = nearest.min(SquaredDistances(points, candidate));
      if (draw > 0 && distances.sum() >= best.sum()) continue;
      best = distances;
      centres.col(k) = candidate;
    }
    nearest = best;
  }
  return centres;
}

/// Index of the nearest centre for each point; returns whether any changed.
bool Assign(const Eigen::Matrix3Xf& points, const Eigen::Matrix3Xf& centres,
            std::vector<int>& cluster_of) {
  bool changed = false;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Index nearest = 0;
    (centres.colwise() - points.col(i)).colwise().squaredNorm().minCoeff(&nearest);
    changed |= cluster_of[i] != nearest;
    cluster_of[i] = static_cast<int>(nearest);
  }
  return changed;
}

/// Means of the clusters without empty ones.
void Update(const Eigen::Matrix3Xf& points, const std::vector<int>& cluster_of,
            KMeansResult& result) {
  const Eigen::Index count = result.centres.cols();
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, count);
  std::vector<int> sizes(count, 0);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    sums.col(cluster_of[i]) += points.col(i).cast<double>();
    ++sizes[cluster_of[i]];
  }
  result.sizes.clear();
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    if (sizes[k] == 0) continue;
    result.centres.col(kept++) = (sums.col(k) / sizes[k]).cast<float>();
    result.sizes.push_back(sizes[k]);
  }
  result.centres.conservativeResize(3, kept);
}

}  // namespace

KMeansResult KMeans(const Eigen::Matrix3Xf& points, const KMeansOptions& options) {
  KMeansResult result;
  if (points.cols() == 0) return result;
  result.centres = Seed(points, options);
  std::vector<int> cluster_of(points.cols(), -1);
  for (int i = 0; i < std::max(options.iterations, 1); ++i) {
    if (!Assign(points, result.centres, cluster_of)) break;
    const Eigen::Index before = result.centres.cols();
    Update(points, cluster_of, result);
    // renumbered
    if (result.centres.cols() != before) std::fill(cluster_of.begin(), cluster_of.end(), -1);
  }
  Assign(points, result.centres, cluster_of);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    result.compactness += (points.col(i) - result.centres.col(cluster_of[i])).squaredNorm();
  }
  return result;
}

}  // namespace sslcd
