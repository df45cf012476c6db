// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "report/run_view.h"
#include "sslcd/core/camera.h"

namespace sslcd {

/// An object as a frame of the run has seen it.
struct Sight {
  int frame = 0;
  int object = 0;  ///< id in the map
  Box2d box;       ///< of the map's cuboid [px]
};

/// Two landmarks that an accepted loop has matched, as seen near its two cameras.
struct SeenPair {
  std::size_t loop = 0, pair = 0;  ///< LoopClosure::pairs[pair] of RunView::loops[loop]
  Sight query, match;
};

/// What a report shows of images at most. Of more loops it takes some, evenly chosen.
struct CropLimits {
  std::size_t loops = 120, pairs = 4;  ///< pairs of a loop
};

/// The matched pairs to show. The map's objects are projected into frames that have observed them,
/// at most three frames for each camera of a loop, so that few images have to be read.
std::vector<SeenPair> SeenPairs(const RunView& run, const Camera& camera,
                                const CropLimits& limits = {});

}  // namespace sslcd
