// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>

#include "bundle/cost_functors.h"

/// The frequent residuals of bundle adjustment with analytic derivatives, which take a fifth of the
/// time of automatic ones. The product of the derivatives with PoseManifold's PlusJacobian is the
/// derivative in its tangent space.
namespace sslcd {

/// ObjectResidual over (camera, object).
class ObjectCost final : public ceres::SizedCostFunction<4, 7, 4> {
 public:
  explicit ObjectCost(const ObjectResidual& residual);
  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override;

 private:
  Eigen::Matrix3d whiten_;  // camera frame -> whitened [radial, lateral, vertical]
  Vec3 measured_;           // whitened
  Vec3 heading_cam_;
  Vec3 forward_, left_;
  double yaw_weight_, yaw_period_;  // weight 0: no yaw
};

/// OdometryResidual over (from, to, log scale).
class OdometryCost final : public ceres::SizedCostFunction<6, 7, 7, 1> {
 public:
  explicit OdometryCost(const OdometryResidual& residual);
  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override;

 private:
  OdometryResidual residual_;
};

}  // namespace sslcd
