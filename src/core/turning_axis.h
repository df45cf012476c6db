// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// The axis of the world about which cameras turn: the vertical for vehicles and walkers. None
/// where they turn by less than half a circle in all, or about no axis more than about others. Its
/// sign is that of the mean up direction of cameras whose y axis points down. T_world_cam.
std::optional<Vec3> TurningAxis(const std::vector<Pose>& cameras);

/// Whether `up` may be the vertical: TurningAxis() is none or within 60 degrees of it or of its
/// opposite.
bool MayBeUp(const Vec3& up, const std::vector<Pose>& cameras);

}  // namespace sslcd
