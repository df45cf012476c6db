// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/camera.h"
#include "sslcd/core/export.h"

namespace sslcd {

/// The smallest box around the image of a cuboid (paper Eq. 1).
/// `T_cam_object` is in the reference camera's frame (see Camera::offset); `dims` is length, width,
/// height [m]. The cuboid is clipped exactly at the depth `near_m`, so the box is correct for
/// cuboids that extend behind the camera or contain it. Clips the box to the image if its size is
/// known. None: the cuboid is behind the camera or outside the image, has no volume or is not
/// finite.
SSLCD_EXPORT std::optional<Box2d> ProjectCuboid(const Pose& T_cam_object, const Vec3& dims,
                                                const Camera& camera, double near_m = 0.1);

/// Eq. 1 as printed: minimum and maximum over the eight projected corners of any depth, not
/// clipped. Meaningless for cuboids that extend behind the camera; for `mode: paper` and
/// comparisons. (The printed formula also omits T_cam_world * T_world_obj; callers pass their
/// product.)
Box2d ProjectCuboidUnclipped(const Pose& T_cam_object, const Vec3& dims, const Camera& camera);

}  // namespace sslcd
