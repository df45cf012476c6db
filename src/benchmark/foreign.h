// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/pose.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::benchmark {

/// ATE after Sim(3) of a trajectory that another system has written (TUM rows, or VINS-Fusion's
/// csv), paired by stamp with the true one. Throws Error(kBadInput): no such file, rows without
/// stamps (KITTI's), or fewer than nine of ten true poses have one of the estimate within 10 ms: a
/// system that was lost for longer has no comparable error.
ErrorStats ForeignAte(const std::string& file, const Trajectory& truth);

}  // namespace sslcd::benchmark
