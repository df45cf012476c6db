// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// Stamps in seconds: a step of 10^7 or more is in ns, of 10^4 or more in us, and of 15 or more in
/// ms, if the camera then moves by less than 0.03 m/s. Needs 3 frames.
Outcome CheckStampUnits(const Sequence& sequence);

/// Positions in metres: objects scatter least with a factor of 0.001, 0.01, 100 or 1000, or the
/// camera is faster than 150 m/s. Needs 15 steps.
Outcome CheckOdometryUnits(const Sequence& sequence);

}  // namespace sslcd::check
