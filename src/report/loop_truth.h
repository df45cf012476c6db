// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "report/run_view.h"

namespace sslcd {

/// A loop that is off by less is right. [m]
inline constexpr double kRightLoopM = 5;

/// The row of `run.truth` that has the time of each row of the trajectory (to 10 ms, as in evo);
/// -1: there is none.
std::vector<int> TrueRows(const RunView& run);

/// How far a loop is off the true relative pose of its cameras; none: unknown. [m]
std::optional<double> LoopError(const RunView& run, const std::vector<int>& true_rows,
                                const LoopClosure& loop);

}  // namespace sslcd
