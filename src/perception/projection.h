// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/camera.h"

namespace sslcd {

/// The smallest box around the image of a cuboid (paper Eq. 1).
/// `T_cam_object` is in the reference camera's frame (Camera::offset leads on to this camera);
/// `dims` = length, width, height [m]. What is nearer than `near_m` is cut off exactly, so the box
/// is right for cuboids that reach behind the camera or contain it. Clipped to the image where its
/// size is known. None: wholly behind the camera or outside the image, no volume, or not finite.
std::optional<Box2d> ProjectCuboid(const Pose& T_cam_object, const Vec3& dims, const Camera& camera,
                                   double near_m = 0.1);

/// Eq. 1 to the letter: minimum and maximum over the eight projected corners, whatever their depth,
/// not clipped. Meaningless for cuboids that reach behind the camera; for `mode: paper` and for
/// comparison. (As printed, the formula also leaves out T_cam_world * T_world_obj; callers hand in
/// their product.)
Box2d ProjectCuboidUnclipped(const Pose& T_cam_object, const Vec3& dims, const Camera& camera);

}  // namespace sslcd
