// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "benchmark/trial.h"

namespace sslcd::benchmark {

/// Small loops (case 4) whose last leg meets the outward pass at an angle from the range "LOW-HIGH"
/// [deg], like --viewpoint-low-deg and --viewpoint-high-deg of sslcd_sim. They add the angles of 15
/// to 135 degrees, which the four cases seldom have. The outward pass of a seed is the same for all
/// ranges, so only keyframes after it count. Key: "lot-vLOW-HIGH". Throws Error(kUsage) unless the
/// range has two whole numbers, 0 <= LOW < HIGH <= 180.
Place PlaceAtViewpoint(const std::string& range);

/// Ranges of 15 degrees from 0 to 180.
std::vector<std::string> ViewpointRanges();

/// Checks that `folder`/WORLD has the rendered sequences of these trials. Throws Error(kBadInput)
/// with the command to make it if a sequence is missing or shows another world.
void CheckRendered(const std::string& folder, const std::vector<Trial>& trials);

}  // namespace sslcd::benchmark
