// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/layout_index.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// Density of the difference of two detected headings of one object [1/rad]: a von Mises density
/// around 0, with shares of reversed and of random headings.
double HeadingDensity(double difference_rad, Symmetry symmetry);

/// HeadingDensity at 0, 1, ... 359 degrees.
const std::vector<double>& HeadingDensities(Symmetry symmetry);

bool HasHeading(const LayoutObject& object);

/// log density of each local object's heading, were the local objects others of the same kind: they
/// then face as the map's objects do, as a whole under whatever turn makes that likeliest. Not
/// under the turn of the pose that is weighed: a pose under which every car faces the wrong way has
/// that against it. 0 for objects without a heading. [log 1/rad]
std::vector<double> ChanceHeadings(const std::vector<LayoutObject>& local,
                                   const LayoutIndex::Headings& map);

}  // namespace sslcd
