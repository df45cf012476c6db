// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/layout_counts.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// Density of the difference of two detected headings of one object [1/rad]: a von Mises density
/// around 0, with shares of reversed and of random headings.
double HeadingDensity(double difference_rad, Symmetry symmetry);

/// HeadingDensity at 0, 1, ... 359 degrees.
const std::vector<double>& HeadingDensities(Symmetry symmetry);

/// Log density of each local object's heading by chance: other objects of the same kind have the
/// headings of the map's objects, rotated by the most likely common angle. It does not use the
/// rotation of the scored pose, so that a pose under which every car has a wrong heading gets a
/// penalty. 0 for objects without a heading. [log 1/rad]
std::vector<double> ChanceHeadings(const std::vector<LayoutObject>& local,
                                   const LayoutCounts::Headings& map);

}  // namespace sslcd
