// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "sslcd/core/detection.h"

namespace sslcd {

/// Whether a pose that somebody else made has a rotation (a quaternion of length 1, neither NaN nor
/// infinity) and a finite translation.
inline bool IsPose(const Pose& T) {
  const double length = T.so3().unit_quaternion().norm();
  return std::abs(length - 1) <= kRotationTolerance && T.translation().allFinite();
}

/// Whether pose and size are such and finite. Others are in no map.
inline bool HasValidGeometry(const Detection& detection) {
  return IsPose(detection.T_cam_object) && detection.dims.allFinite();
}

}  // namespace sslcd
