// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/loop_closure.h"

namespace sslcd {

/// Returns the text of loops.csv: a row for each attempt to close a loop, accepted or not
/// (docs/formats.md).
std::string LoopsCsv(const std::vector<LoopClosure>& loops);

/// Reads loops.csv. `id`, `newest_frame` and `covariance` are not in the file. Throws
/// Error(kBadInput) with file and line.
std::vector<LoopClosure> ReadLoopsCsv(const std::string& path);

}  // namespace sslcd
