// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/loop_ledger.h"
#include "closing/pass_map.h"
#include "refine/fuse.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// The steps that correct trajectory and map by the accepted loops, in their order. Each is a
/// function of the state and the ledger. `factors` are on LoopOptions::odometry.

/// Whether the trajectory already agrees with all loops that are not solved yet.
bool AgreesWithNewLoops(const MapState& state, const LoopLedger& ledger);

/// Solves the pose graph with all loops ever accepted and moves trajectory and map. If
/// `options.robust`, it decides about each of these loops again. False: not solvable, nothing has
/// moved.
bool CorrectTrajectory(MapState& state, LoopLedger& ledger, double scale,
                       const LoopOptions& options, const DetectionNoise& noise,
                       const OdometryFactors& factors);

/// Fuses matched objects of accepted loops that are within `fuse_m` of each other, and the
/// duplicates that this reveals. If a loop that has fused objects is no longer accepted, splits all
/// fused landmarks before (SplitFused), so that the accepted loops alone decide what is fused.
void FuseMatchedObjects(MapState& state, PassMap& passes, LoopLedger& ledger, double fuse_m,
                        const WholeMapOptions& options);

/// Adjusts cameras and objects after a loop closure: a few steps of bundle adjustment over the
/// keyframes of the pose graph, with fixed scale and the odometry noise of the pose graph. Not
/// usable, and nothing moves, if there are more keyframes than `options.adjust_keyframes`.
BaSummary AdjustAfterLoop(MapState& state, double scale, const LoopOptions& options,
                          const WholeMapOptions& whole_map, const OdometryFactors& factors);

/// The motion of the layout around a camera: yaw about the camera and shift. Heights are relative
/// to the layout and stay.
YawShift LayoutChange(const Pose& T_before, const Pose& T_now, const GravityFrame& gravity);

}  // namespace sslcd
