// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Path length from the start to each pose. [m]
std::vector<double> DistanceAlong(const std::vector<Pose>& poses);

/// Horizontal viewing direction of a camera (KITTI axes). [rad]
double HeadingOf(const Pose& T_world_cam);

}  // namespace sslcd
