// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/pose.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::benchmark {

/// ATE after Sim(3) of another system's trajectory (TUM rows, or VINS-Fusion's csv), paired by
/// stamp with the true one. Throws Error(kBadInput) if the file is missing, if rows have no stamps
/// (KITTI's), or if fewer than nine of ten true poses have an estimate within 10 ms: the error of a
/// system that was lost for longer is not comparable.
ErrorStats ForeignAte(const std::string& file, const Trajectory& truth);

}  // namespace sslcd::benchmark
