// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "report/drawing.h"
#include "report/run_view.h"

namespace sslcd {

struct DrawOptions {
  int width = 1200;  ///< of the picture; its height follows from the map [px]
  /// draw at most so many accepted loops, evenly chosen; none: all
  std::optional<int> max_loops;
  /// draw only the accepted loop of this query frame, with both cameras and its matched objects
  std::optional<int> loop;
  /// two maps beside each other: the loops on the odometry, and on the corrected trajectory
  bool before_after = false;
};

/// Draws the map from above with odometry, trajectory, truth and loops, a legend and a scale bar.
/// The picture is the same for each up axis. Throws Error(kUsage) if `loop` is no accepted loop,
/// and Error(kBadInput) if the run has no poses.
Drawing DrawRun(const RunView& run, const DrawOptions& options = {});

}  // namespace sslcd
