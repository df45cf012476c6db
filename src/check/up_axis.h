// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// Up in the odometry's world. Vehicles turn about the vertical and stay on a ground, so that the
/// normal of the plane of cameras and objects is vertical, too. The declared axis is wrong if it
/// lies more than 60 degrees off that normal while the camera's own up is within 30 degrees of it,
/// or if both point the other way. Needs 50 objects that spread at least 5 times as far along the
/// plane as across it.
Outcome CheckUpAxis(const Sequence& sequence);

}  // namespace sslcd::check
