// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "map/map_state.h"

/// What happens to trajectory and map when keyframes move: after an optimisation, after a loop
/// closure.
namespace sslcd {

/// Keyframes of a trajectory, as indices into `frames`: the first frame, then one after every
/// `distance_m` of odometry path or every turn of `turn_rad`, and the last frame. Empty for no
/// frames.
std::vector<int> SelectKeyframes(const FrameStore& frames, double distance_m, double turn_rad);

/// Gives keyframes (ascending indices into `frames`) new poses T_world_cam. A frame between two
/// keyframes keeps its pose relative to the one before, plus its share, by path travelled, of what
/// the next one was corrected relative to it: the trajectory stays smooth. Frames before the first
/// or after the last keyframe move rigidly with that.
void MoveKeyframes(FrameStore& frames, const std::vector<int>& keyframes,
                   const std::vector<Pose>& poses);

/// Every landmark, whatever its state, follows the frames that saw it from their poses `before`
/// (one a frame) to where they are now: to the information-weighted mean of where each of its
/// sightings' cameras would carry it, turned about the vertical only. Its motion test moves along.
/// Landmarks seen by none of the frames stay.
void MoveObjects(MapState& state, const std::vector<Pose>& before, const DetectionNoise& noise);

}  // namespace sslcd
