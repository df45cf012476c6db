// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Largest |R^T R - I| or ||q| - 1| of a file that is read; rounding errors are smaller.
constexpr double kRotationTolerance = 1e-2;

/// Returns [R t] with R replaced by the nearest rotation. None if R differs from it by more than
/// the tolerance, is a reflection, or a value is not finite.
std::optional<Pose> RigidFromMatrix(const Eigen::Matrix3d& R, const Vec3& t);

}  // namespace sslcd
