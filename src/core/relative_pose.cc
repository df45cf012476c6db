// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/relative_pose.h"

#include <Eigen/Cholesky>

#include "sslcd/core/math.h"

namespace sslcd {

bool Agrees(const RelativePose& measured, const Pose& T_a_b, double probability) {
  const Vec6 error = (measured.T_a_b.inverse() * T_a_b).Log();
  const Eigen::Matrix<double, 6, 6> covariance = measured.covariance;
  return error.dot(covariance.ldlt().solve(error)) < Chi2Quantile(probability, 6);
}

}  // namespace sslcd
