// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include "bundle/object_ba.h"

namespace sslcd {

/// r = r0 + J (x - x0) over the blocks named by a BaPrior: cameras, objects, log scale, in this
/// order. The difference is Log(x0^-1 x) for cameras, and wrapped to (-pi, pi] for the yaw of
/// objects.
class MarginalPriorCost final : public ceres::CostFunction {
 public:
  explicit MarginalPriorCost(const BaPrior& prior);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  BaPrior prior_;
};

}  // namespace sslcd
