// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/pose.h"

namespace sslcd {

/// Pose of a gravity-aligned object: where its centre is and which way it faces. Roll and pitch are
/// zero (paper III-A.1).
struct UprightPose {
  Vec3 position{0, 0, 0};  ///< centre in the world [m]
  double yaw = 0;          ///< about the world's up, see GravityFrame [rad]
};

Pose ToPose(const UprightPose& upright, const GravityFrame& gravity);  // T_world_object
// drops roll and pitch
UprightPose ToUpright(const Pose& T_world_object, const GravityFrame& gravity);

}  // namespace sslcd
