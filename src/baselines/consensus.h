// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <optional>
#include <random>
#include <vector>

#include "baselines/answer.h"
#include "sslcd/core/fields.h"

namespace sslcd::baselines {

/// The columns with the largest entries of each row, at most `candidates` of them, none below
/// `least` and none <= 0. Of equal ones the first.
ObjectPairs BestPairs(const Eigen::MatrixXd& similarity, double least, int candidates);

/// RANSAC (Fischler and Bolles 1981) over matches of which many are wrong.
struct ConsensusOptions {
  int samples = 1000;     ///< poses tried, each from two matches drawn at random
  double inlier_m = 1;    ///< matches that agree with a pose are at most this far apart under it
  int least_inliers = 5;  ///< fewer are no pose
};
void DescribeFields(FieldVisitor& visitor, ConsensusOptions& options);

/// The pose that most pairs agree with, and these: one to one, nearest first. Then least squares
/// over them. A pose is a turn about the vertical and a shift, since gravity is known; two pairs
/// fix it. The score is the number of matches; where they are fewer than `least_inliers` there is
/// no answer.
std::optional<Answer> LargestConsensus(const std::vector<LayoutObject>& local,
                                       const std::vector<LayoutObject>& global,
                                       const ObjectPairs& pairs, const ConsensusOptions& options,
                                       std::mt19937_64& random);

}  // namespace sslcd::baselines
