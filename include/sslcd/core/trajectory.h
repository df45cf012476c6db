// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Stamped poses, in time order. `poses[i]` is T_world_cam at `stamps[i]` [s]; both of the same
/// length.
struct Trajectory {
  std::vector<double> stamps;
  std::vector<Pose> poses;
  std::size_t size() const { return poses.size(); }
};

}  // namespace sslcd
