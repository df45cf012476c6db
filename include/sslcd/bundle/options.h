// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/odometry/options.h"

namespace SSLCD_EXPORT sslcd {

/// Object bundle adjustment, paper III-C.
struct BaOptions {
  enum class Residual { kRobust, kPaper };
  enum class Solver { kLevenbergMarquardt, kGaussNewton };
  Residual residual = Residual::kRobust;
  Solver solver = Solver::kLevenbergMarquardt;
  int max_iterations = 30;
  /// robust: scale of the Cauchy loss on each sighting's whitened residual; 0: none. Small, since
  /// some noisy detections join a neighbour, which makes the map smaller.
  double loss_scale = 1.;
  /// robust: factor on detection sigmas, because errors of successive frames correlate
  double correlation = 2.;
  OdometryNoise odometry;
};
void DescribeFields(FieldVisitor& visitor, BaOptions& options);

/// What a bundle adjustment did.
struct BaSummary {
  bool usable = false;  ///< false: the problem is unchanged
  bool converged = false;
  int iterations = 0;
  double initial_cost = 0, final_cost = 0;  ///< half the sum of squared, robust residuals
  std::string message;                      ///< one line
};

/// Probability that an optimised trajectory is nearer to the truth than odometry, by what its own
/// covariance says: of its horizontal positions and of its heights. At least .5; zero where it was
/// not asked (no refinement, no least probability, or an up axis that cannot be). See
/// RefineOptions::least_probability.
struct ImprovementProbability {
  double horizontal = 0, height = 0;
};

}  // namespace sslcd
