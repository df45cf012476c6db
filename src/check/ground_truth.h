// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// Ground truth of this drive: how far the camera gets in a 100th, a 30th and a 12th of the drive
/// is the same in ground truth and odometry, in any frame and up to one scale. The statistic is the
/// mean relative difference of these distances after the median ratio is taken out, the worst of
/// the three; also with the inverse of the ground-truth poses. Needs 8 such distances.
/// Then the axes of its poses (FindBodyAxes).
Outcome CheckGroundTruth(const Sequence& sequence);

}  // namespace sslcd::check
