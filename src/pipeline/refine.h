// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// The full-map optimisation: bundle adjustment over every frame and every standing object, then association anew with
/// what that has found, fusion of duplicates and rejection of what has moved; `options.refine.rounds` times. Changes
/// map, frames and scale.
BaSummary RefineMap(ObjectMap& map, std::vector<FrameRecord>& frames, double& log_scale, const Options& options,
                    const Camera* camera);

}  // namespace sslcd
