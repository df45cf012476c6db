// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// times.txt: one stamp a row, increasing. [s] Throws Error with file:line.
std::vector<double> ReadTimes(const std::string& path);
std::string TimesText(const std::vector<double>& stamps);

/// Median difference of neighbours; 0 for fewer than two stamps. [s]
double MedianStep(const std::vector<double>& stamps);

/// A sentence about the gaps of more than ten median steps, if there are any.
std::optional<std::string> GapWarning(const std::vector<double>& stamps);

/// The pose nearest to each stamp. Throws Error naming the first stamp that has none within half a
/// median step.
std::vector<Pose> PosesAt(const std::vector<double>& stamps, const Trajectory& trajectory,
                          const std::string& path);

}  // namespace sslcd
