// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace sslcd {

/// The logistic function 1 / (1 + exp(-x)), which maps a logit to a probability.
inline double Sigmoid(double x) { return 1 / (1 + std::exp(-x)); }

}  // namespace sslcd
