// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// Whether odometry and detections are of the same drive and the same frames. Objects that are seen
/// together show how the camera turns; the odometry has to turn as much at that time. Tries shifts
/// of up to 10 frames. Needs 20 pairs of frames that turn by 0.05 rad or more, with four objects
/// each.
Outcome CheckSynchronisation(const Sequence& sequence);

}  // namespace sslcd::check
