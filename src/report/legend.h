// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/drawing.h"
#include "sslcd/core/loop_closure.h"

namespace sslcd {

/// What the legend of a drawn run says.
struct Legend {
  std::map<std::string, Colour> labels;
  std::size_t all_loops = 0;
  std::vector<LoopClosure> loops;  ///< those drawn
  bool truth = false;
  bool one_loop = false;  ///< one loop with its cameras
  double scale = 1;       ///< of the map [px/m]
};

/// Adds the legend below `top`, in as many rows as it needs, and a scale bar. Returns the height.
/// [px]
double DrawLegend(const Legend& legend, double top, Drawing& page);

}  // namespace sslcd
