// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>

#include "loop/drift.h"

namespace sslcd {

std::optional<Pose> SolveDriftAsPrinted(const std::vector<DriftPair>& pairs) {
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  constexpr int kMaxIterations = 50;    // the paper prints none; set by hand
  constexpr double kLeastStep = 1e-10;  // norm of the last step [m, rad]
  if (pairs.empty()) return std::nullopt;
  Pose T_drift;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Mat6 H = Mat6::Zero();
    Vector6 b = Vector6::Zero();
    for (const DriftPair& pair : pairs) {
      // Eq. 18
      const auto r =
          (T_drift.inverse() * (pair.T_world_local.inverse() * pair.T_world_global)).Log();
      // T_drift Exp(d) multiplies by Exp(-d) on the left: dr/dd = -J_l^-1(r).
      const Mat6 J = -Pose::LeftJacobianInverse(r);
      H += J.transpose() * J;
      b += J.transpose() * r;
    }
    const Vector6 step = -H.ldlt().solve(b);
    if (!step.allFinite()) return std::nullopt;
    T_drift = T_drift * Pose::Exp(step);
    if (step.norm() < kLeastStep) break;
  }
  return T_drift;
}

}  // namespace sslcd
