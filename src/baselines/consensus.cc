// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/consensus.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "loop/layout_likelihood.h"

namespace sslcd::baselines {
namespace {

using Objects = std::vector<LayoutObject>;

constexpr int kRounds = 5;  // of least squares; in most cases two are enough

ObjectPairs Agreeing(const Objects& local, const Objects& global, const ObjectPairs& pairs,
                     const YawShift& pose, double inlier_m) {
  std::vector<std::tuple<double, int, int>> near;
  for (const auto& [l, g] : pairs) {
    const double distance = (Apply(pose, local[l].position) - global[g].position).norm();
    if (distance <= inlier_m) near.emplace_back(distance, l, g);
  }
  std::sort(near.begin(), near.end());
  std::vector<bool> local_taken(local.size()), global_taken(global.size());
  ObjectPairs agreeing;
  for (const auto& [distance, l, g] : near) {
    if (local_taken[l] || global_taken[g]) continue;
    local_taken[l] = global_taken[g] = true;
    agreeing.emplace_back(l, g);
  }
  std::sort(agreeing.begin(), agreeing.end());
  return agreeing;
}

YawShift PoseOf(const Objects& local, const Objects& global, const ObjectPairs& pairs) {
  std::vector<Vec3> from, to;
  for (const auto& [l, g] : pairs) {
    from.push_back(local[l].position);
    to.push_back(global[g].position);
  }
  return AlignPoints(from, to);
}

}  // namespace

ObjectPairs BestPairs(const Eigen::MatrixXd& similarity, double least, int candidates) {
  ObjectPairs pairs;
  for (int row = 0; row < similarity.rows(); ++row) {
    std::vector<std::pair<double, int>> best;
    for (int column = 0; column < similarity.cols(); ++column)
      if (similarity(row, column) > 0 && similarity(row, column) >= least)
        best.emplace_back(-similarity(row, column), column);
    std::sort(best.begin(), best.end());
    best.resize(std::min<std::size_t>(best.size(), candidates));
    for (const auto& [negative, column] : best) pairs.emplace_back(row, column);
  }
  return pairs;
}

void DescribeFields(FieldVisitor& visitor, ConsensusOptions& options) {
  visitor.Integer("samples", options.samples, 1, 1000000, "poses that RANSAC tries");
  visitor.Real("inlier_m", options.inlier_m, 1e-3, 1000,
               "how far apart matches that agree with a pose may be");
  visitor.Integer("least_inliers", options.least_inliers, 2, 1000,
                  "a pose has at least this many matches");
}

std::optional<Answer> LargestConsensus(const Objects& local, const Objects& global,
                                       const ObjectPairs& pairs, const ConsensusOptions& options,
                                       std::mt19937_64& random) {
  Answer best;
  for (int sample = 0; sample < options.samples && pairs.size() >= 2; ++sample) {
    const auto& [l, g] = pairs[random() % pairs.size()];
    const auto& [other_l, other_g] = pairs[random() % pairs.size()];
    const double local_m = (local[l].position - local[other_l].position).head<2>().norm();
    const double global_m = (global[g].position - global[other_g].position).head<2>().norm();
    // Two close matches do not determine the heading. Consistent matches have equal distances in
    // both maps.
    if (!(std::min(local_m, global_m) > options.inlier_m) ||
        !(std::abs(local_m - global_m) <= 2 * options.inlier_m))
      continue;
    const YawShift pose = PoseOf(local, global, {{l, g}, {other_l, other_g}});
    ObjectPairs agreeing = Agreeing(local, global, pairs, pose, options.inlier_m);
    if (agreeing.size() > best.matches.size()) best = {std::move(agreeing), pose};
  }
  for (int round = 0; round < kRounds && !best.matches.empty(); ++round) {
    best.pose = PoseOf(local, global, best.matches);
    ObjectPairs agreeing = Agreeing(local, global, pairs, best.pose, options.inlier_m);
    if (agreeing == best.matches) break;
    best.matches = std::move(agreeing);
  }
  if (static_cast<int>(best.matches.size()) < options.least_inliers) return std::nullopt;
  best.score = static_cast<double>(best.matches.size());
  best.accepted = true;
  return best;
}

}  // namespace sslcd::baselines
