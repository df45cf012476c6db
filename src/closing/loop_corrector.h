// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/loop_ledger.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Brings trajectory and map in line with the accepted loops. The steps in their order; each is a
/// function of the state and the ledger.

/// Whether the trajectory already goes through all loops that no solve has seen yet.
bool AgreesWithNewLoops(const MapState& state, const LoopLedger& ledger);

/// Solves the pose graph with all loops ever accepted, which decides again about each of them if
/// `options.robust`, and moves trajectory and map. False: not solvable, nothing has moved.
bool CorrectTrajectory(MapState& state, LoopLedger& ledger, double scale,
                       const LoopOptions& options, const DetectionNoise& noise);

/// Matched objects of accepted loops become one landmark where they lie within `fuse_m` of each
/// other, and so do the duplicates that this brings to light. The ledger's ids follow.
MergedIds FuseMatchedObjects(MapState& state, LoopLedger& ledger, double fuse_m,
                             const WholeMapOptions& options);

/// Adjusts cameras and objects after a loop has moved them: a few steps of bundle adjustment over
/// the keyframes of the pose graph, with the scale as it is and odometry as loose as there. Not
/// usable, and nothing moves, where there are more keyframes than `options.adjust_keyframes`.
BaSummary AdjustAfterLoop(MapState& state, double scale, const LoopOptions& options,
                          const WholeMapOptions& whole_map);

/// How the layout around a camera moves with it: yaw about its place. Heights are the layout's own
/// and stay.
YawShift LayoutChange(const Pose& T_before, const Pose& T_now, const GravityFrame& gravity);

}  // namespace sslcd
