// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "closing/loop_ledger.h"
#include "odometry/odometry_by_loops.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Reviews the loops after refinement and new association: withdraws loops that the trajectory
/// contradicts (IsWithdrawn), and measures the others again from the common objects of both passes.
/// Odometry errors deformed both maps at the first measurement; the refinement has removed these
/// errors. Changes only the measurements that a host reads: decisions keep the first measurement,
/// because the loop itself has corrected the maps.
void ReviewLoops(const MapState& state, const PassMap& passes, LoopLedger& ledger,
                 const LoopOptions& options, const OdometryFactors& factors = {});

/// Measures accepted loops through a tie of aligned images if this is more certain than their
/// objects: from the match camera along its pass to the tie, across the tie, and along the other
/// pass to the query camera. `scale` is metres per odometry metre.
void MeasureByViews(const MapState& state, const std::vector<ViewTie>& ties, double scale,
                    const OdometryNoise& noise, LoopLedger& ledger);

/// Learns the errors of odometry from the accepted loops (LearnOdometryByLoops): factors on the
/// noise `options.odometry`, and the turn of the heading, of which `corrected` has been taken out
/// of FrameRecord::T_odom_cam. Nothing is learnt if `options.learn_odometry` is off.
OdometryByLoops LearnOdometry(const MapState& state, const LoopLedger& ledger, double scale,
                              const LoopOptions& options, double corrected);

/// The factors of the refinement, not below those `in_sight`. Passes in the same direction share
/// errors of heading, which no loop between them shows. Errors of position may be large from frame
/// to frame and not add up (a camera that is not where it is taken to be): that factor is not below
/// the one in sight without its caution. Those of height and tilt are always the ones in sight.
/// Those of position and heading are one if `options.learn_odometry` is off.
OdometryFactors FactorsOfRefinement(const OdometryByLoops& by_loops,
                                    const OdometryFactors& in_sight, const LoopOptions& options);

}  // namespace sslcd
