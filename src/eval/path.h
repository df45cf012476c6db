// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Length of the path up to each pose. [m]
std::vector<double> DistanceAlong(const std::vector<Pose>& poses);

/// Direction a camera (KITTI axes) looks in, in the horizontal plane. [rad]
double HeadingOf(const Pose& T_world_cam);

}  // namespace sslcd
