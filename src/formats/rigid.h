// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/pose.h"

namespace sslcd {

/// How far |R^T R - I| or |q| - 1 may be off before a file is refused: more than rounding ever
/// explains.
constexpr double kRotationTolerance = 1e-2;

/// [R t] with R replaced by the nearest rotation; none if R is further than the tolerance from one,
/// mirrored, or anything is not finite.
std::optional<Pose> RigidFromMatrix(const Eigen::Matrix3d& R, const Vec3& t);

}  // namespace sslcd
