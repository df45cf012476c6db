// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <optional>
#include <random>
#include <vector>

#include "baselines/answer.h"
#include "sslcd/core/fields.h"

namespace sslcd::baselines {

/// Selects up to `candidates` columns with the largest entries per row, which must be >= `least`
/// and > 0. On a tie the first column wins.
ObjectPairs BestPairs(const Eigen::MatrixXd& similarity, double least, int candidates);

/// Options of RANSAC (Fischler and Bolles 1981) over matches.
struct ConsensusOptions {
  int samples = 1000;     ///< number of poses, each from two random matches
  double inlier_m = 1;    ///< largest distance of an inlier
  int least_inliers = 5;  ///< smallest number of inliers of a pose
};
void DescribeFields(FieldVisitor& visitor, ConsensusOptions& options);

/// Estimates the pose with most inliers (one to one, nearest first), followed by least squares. A
/// pose is a yaw and a shift, since gravity is known; two pairs determine it. The score is the
/// number of matches. None: fewer than `least_inliers` matches.
std::optional<Answer> LargestConsensus(const std::vector<LayoutObject>& local,
                                       const std::vector<LayoutObject>& global,
                                       const ObjectPairs& pairs, const ConsensusOptions& options,
                                       std::mt19937_64& random);

}  // namespace sslcd::baselines
