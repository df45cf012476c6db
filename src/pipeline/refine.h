// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// What loops say beyond the objects that they have made one.
struct LoopEvidence {
  OdometryFactors odometry_factors;  ///< on `options.ba.odometry`
  std::vector<ViewTie> view_ties;
};

/// The full-map optimisation: bundle adjustment over every frame and every standing object, then
/// association anew with what that has found, fusion of duplicates and rejection of what has moved;
/// `options.refine.rounds` times. Changes map, frames and scale.
BaSummary RefineMap(ObjectMap& map, std::vector<FrameRecord>& frames, double& log_scale,
                    const LoopEvidence& loops, const Options& options, const Camera* camera);

/// Cameras and objects after a loop has moved them: a bundle adjustment over a keyframe every
/// `options.loop.keyframe_m`, a few steps, with the scale as it is and odometry as loose as in the
/// pose graph. Not usable, and nothing moves, where there are more keyframes than
/// `options.loop.adjust_keyframes`.
BaSummary OptimiseAfterLoop(ObjectMap& map, std::vector<FrameRecord>& frames, double scale,
                            const Options& options);

}  // namespace sslcd
