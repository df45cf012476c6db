// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// Numbers of frames: from 0, as the poses count.
Outcome CheckFrameNumbers(const Sequence& sequence);

/// Sizes and places in metres: the median of the largest side is at most 100 m, and that of the
/// distances at most 300 sides. Needs 20 rows.
Outcome CheckCuboidUnits(const Sequence& sequence);

/// Places in the camera's axes rather than a laser's (x forward, z up): there the third coordinate
/// is a height, a few metres about 0 that vary little. Needs 50 rows.
Outcome CheckDetectionAxes(const Sequence& sequence);

}  // namespace sslcd::check
