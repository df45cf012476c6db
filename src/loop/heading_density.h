// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/label.h"

namespace sslcd {

/// Density of the difference of two detected headings of one object [1/rad]: a von Mises density
/// around 0, with shares of reversed and of random headings.
double HeadingDensity(double difference_rad, Symmetry symmetry);

/// HeadingDensity at 0, 1, ... 359 degrees.
const std::vector<double>& HeadingDensities(Symmetry symmetry);

}  // namespace sslcd
