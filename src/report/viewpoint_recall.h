// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/run_view.h"

namespace sslcd {

/// What became of the places to which the camera came back with one change of viewpoint.
struct ViewpointCounts {
  int revisits = 0;    ///< keyframes at a place where the camera has been
  int recognised = 0;  ///< those with a right loop nearby
  int loops = 0;       ///< accepted loops whose cameras truly differ so
  int right = 0;       ///< those that are off by less than kRightLoopM
};

inline constexpr int kViewpointStepDeg = 15;

/// Bins of 15 degrees from 0 to 180, by the true poses alone: RevisitOptions without objects in
/// common. Empty where a tenth of the frames or more have no true pose.
std::vector<ViewpointCounts> ViewpointRecall(const RunView& run, const std::vector<int>& true_rows);

}  // namespace sslcd
