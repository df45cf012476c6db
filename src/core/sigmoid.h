// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace sslcd {

/// The logistic function 1 / (1 + exp(-x)): the probability that a logit stands for.
inline double Sigmoid(double x) { return 1 / (1 + std::exp(-x)); }

}  // namespace sslcd
