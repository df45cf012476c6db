// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "refine/optimise_map.h"
#include "sslcd/core/camera.h"

namespace sslcd {

/// The full-map optimisation: bundle adjustment over all frames and all parked objects, new
/// association with the result, fusion of duplicates and rejection of moved objects,
/// `options.refine.rounds` times. Changes map, frames and scale. `camera` may be null; then
/// association does not use 2D boxes.
BaSummary RefineMap(MapState& state, double& log_scale, const LoopEvidence& loops,
                    const WholeMapOptions& options, const Camera* camera);

}  // namespace sslcd
