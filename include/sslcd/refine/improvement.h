// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sslcd {

/// Probability that the optimised trajectory is nearer to the truth than odometry, by what its own
/// covariance says: of its horizontal positions and of its heights. See
/// RefineOptions::least_probability.
struct ImprovementProbability {
  double horizontal = 0, height = 0;
};

}  // namespace sslcd
