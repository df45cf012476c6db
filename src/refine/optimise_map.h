// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "bundle/object_ba.h"
#include "map/map_state.h"
#include "odometry/odometry_noise.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Constraints of the full-map optimisation from loops, beyond fused objects.
struct LoopEvidence {
  OdometryFactors odometry_factors;  ///< factors on BaOptions::odometry
  std::vector<ViewTie> view_ties;
};

/// The problem of OptimiseMap() at the current state.
BaProblem MapProblem(const MapState& state, const std::vector<int>& keyframes, double log_scale,
                     const LoopEvidence& loops, const WholeMapOptions& options);

/// Bundle adjustment over keyframes (indices of frames) and all landmarks of the map, repeated with
/// the learnt detector noise if `options.map.learn_noise`. Sightings of other frames are assigned
/// to the nearest keyframe. Other frames and objects follow the result. Moves trajectory, map and
/// scale; changes nothing if the summary is not usable.
BaSummary OptimiseMap(MapState& state, const std::vector<int>& keyframes, double& log_scale,
                      const LoopEvidence& loops, const WholeMapOptions& options);

/// Poses of all sightings of a landmark in the world. `cameras` has T_world_cam by frame number.
std::vector<UprightPose> SeenAt(const MapLandmark& landmark, const std::map<int, Pose>& cameras,
                                const GravityFrame& gravity);

}  // namespace sslcd
