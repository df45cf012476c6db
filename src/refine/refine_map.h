// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "refine/optimise_map.h"
#include "sslcd/core/camera.h"

namespace sslcd {

/// The full-map optimisation: bundle adjustment over every frame and every parked object, then
/// association again with the result, fusion of duplicates and rejection of what has moved;
/// `options.refine.rounds` times. Changes map, frames and scale. `camera` may be null: boxes then
/// take no part in association.
BaSummary RefineMap(MapState& state, double& log_scale, const LoopEvidence& loops,
                    const WholeMapOptions& options, const Camera* camera);

}  // namespace sslcd
