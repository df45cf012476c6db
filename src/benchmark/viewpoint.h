// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "benchmark/trial.h"

namespace sslcd::benchmark {

/// The four cases seldom meet their way out at 15 to 135 degrees. These do: small loops (case 4)
/// whose last leg crosses or follows it at an angle from a range, "LOW-HIGH" [deg], as
/// --viewpoint-low-deg and --viewpoint-high-deg of sslcd_sim have it. The way out of a seed is the
/// same for all ranges, so keyframes count from where it ends. Key: "lot-vLOW-HIGH". Throws
/// Error(kUsage) on anything but two whole numbers, 0 <= LOW < HIGH <= 180.
Place PlaceAtViewpoint(const std::string& range);

/// All the way round, 15 degrees each.
std::vector<std::string> ViewpointRanges();

/// Are the rendered sequences of these trials in `folder`/WORLD? Throws Error(kBadInput) where one
/// is not there, or is of another world, with the command that makes it.
void CheckRendered(const std::string& folder, const std::vector<Trial>& trials);

}  // namespace sslcd::benchmark
