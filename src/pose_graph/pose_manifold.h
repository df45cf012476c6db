// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/manifold.h>

namespace sslcd {

/// SE(3) for Ceres: x = [qx qy qz qw tx ty tz], right perturbation x * Exp(d), d = [rho, phi].
/// Ceres' own EigenQuaternionManifold is a left perturbation in half angles.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace sslcd
