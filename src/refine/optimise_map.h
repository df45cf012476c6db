// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "map/map_state.h"
#include "odometry/odometry_noise.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// What loops say beyond the objects that they have made one.
struct LoopEvidence {
  OdometryFactors odometry_factors;  ///< on BaOptions::odometry
  std::vector<ViewTie> view_ties;
};

/// Bundle adjustment over keyframes (indices of frames) and every landmark of the map, once more
/// with the detector's noise learnt if `options.map.learn_noise`. What other frames saw counts as
/// seen from the nearest keyframe; frames and objects that take no part follow. Moves trajectory,
/// map and scale; nothing moves where the summary is not usable.
BaSummary OptimiseMap(MapState& state, const std::vector<int>& keyframes, double& log_scale,
                      const LoopEvidence& loops, const WholeMapOptions& options);

/// Poses of all sightings of a landmark in the world. `cameras`: frame number -> T_world_cam.
std::vector<UprightPose> SeenAt(const MapLandmark& landmark, const std::map<int, Pose>& cameras,
                                const GravityFrame& gravity);

}  // namespace sslcd
