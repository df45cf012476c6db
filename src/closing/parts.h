// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "closing/loop_graph.h"
#include "map/map_state.h"
#include "sslcd/core/detection_noise.h"

namespace sslcd {

/// For each part of the run (FrameStore::parts) the earliest one that loops join it with, maybe
/// over others; itself if none does.
std::vector<int> JoinParts(const FrameStore& frames, const std::vector<LoopEdge>& loops);

/// Moves parts, and what was seen on them, to where loops say that they are: for each of `found`
/// that joins two parts that neither `known` nor a loop before it has joined, the later one with
/// all that is joined to it, by yaw and shift. So a solver starts near its solution.
void PlaceParts(MapState& state, std::vector<LoopEdge> known, const std::vector<LoopEdge>& found,
                const DetectionNoise& noise);

/// Where a new part begins whose place nobody knows, at `T_odom_cam` in its odometry: beside the
/// map, so that nothing of it seems to be where other objects are. O(frames)
Pose PlaceBeside(const MapState& state, const Pose& T_odom_cam);

}  // namespace sslcd
