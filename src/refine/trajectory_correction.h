// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "map/map_state.h"

/// Moves trajectory and map with the keyframes, after an optimisation or a loop closure.
namespace sslcd {

/// Selects keyframes, as indices into `frames`: the first frame, then one after every `distance_m`
/// of odometry path or rotation of `turn_rad`, the last frame, and the last frame before and the
/// first one after the odometry was lost. Empty for no frames.
std::vector<int> SelectKeyframes(const FrameStore& frames, double distance_m, double turn_rad);

/// Sets new poses T_world_cam of keyframes (ascending indices into `frames`). A frame between two
/// keyframes keeps its pose relative to the previous one, plus a share of the next one's relative
/// correction in proportion to the path, so the trajectory stays smooth. Frames before the first or
/// after the last keyframe move rigidly with it.
void MoveKeyframes(FrameStore& frames, const std::vector<int>& keyframes,
                   const std::vector<Pose>& poses);

/// Moves all landmarks with the frames that saw them, from their poses `before` (one per frame) to
/// the current ones. A landmark moves to the information-weighted mean of the positions that its
/// sightings give, and rotates only about the vertical. Its motion test moves with it. Landmarks
/// without sightings in these frames stay.
void MoveObjects(MapState& state, const std::vector<Pose>& before, const DetectionNoise& noise);

}  // namespace sslcd
