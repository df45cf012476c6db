// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Reads times.txt: one stamp [s] per row, increasing. Throws Error with file:line.
std::vector<double> ReadTimes(const std::string& path);
std::string TimesText(const std::vector<double>& stamps);

/// Median step between consecutive stamps; 0 for fewer than two stamps. [s]
double MedianStep(const std::vector<double>& stamps);

/// A warning about gaps of more than ten median steps, if there are any.
std::optional<std::string> GapWarning(const std::vector<double>& stamps);

/// The index of the pose nearest in time to each stamp. Throws Error with the first stamp that has
/// no pose within half a median step.
std::vector<std::size_t> NearestPoses(const std::vector<double>& stamps,
                                      const Trajectory& trajectory, const std::string& path);

}  // namespace sslcd
