// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/upright.h"

namespace sslcd {

Pose ToPose(const UprightPose& upright, const GravityFrame& gravity) {
  return Pose(gravity.Upright(upright.yaw), upright.position);
}

UprightPose ToUpright(const Pose& T_world_object, const GravityFrame& gravity) {
  return {T_world_object.translation(), gravity.YawOf(T_world_object.so3())};
}

}  // namespace sslcd
