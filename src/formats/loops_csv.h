// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/loop_closure.h"

namespace sslcd {

/// Returns the text of loops.csv: a row for each attempt to close a loop, accepted or not
/// (docs/formats.md).
std::string LoopsCsv(const std::vector<LoopClosure>& loops);

}  // namespace sslcd
