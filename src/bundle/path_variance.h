// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "bundle/object_ba.h"

namespace sslcd {

/// Variances of linear functions of the camera positions p_i, given all residuals of a solved
/// problem: var(sum_i d_i . p_i) = d^T H^-1 d, with the Gauss-Newton Hessian H at the current
/// states. Without the losses: they give ordinary errors a part of their weight, too, which is no
/// lack of information. Each function is a matrix with the d_i as columns, in the world. None: H is
/// singular, or a residual is not finite.
std::optional<std::vector<double>> PathVariances(const BaProblem& problem, const BaOptions& options,
                                                 const std::vector<Eigen::Matrix3Xd>& functions);

}  // namespace sslcd
