// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "closing/loop_ledger.h"
#include "odometry/odometry_noise.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// After everything was refined and associated again: withdraws the loops that the trajectory
/// contradicts (IsWithdrawn), and measures the others again from the objects that both passes have
/// in common now. At first the two maps were bent by the odometry between their objects; they no
/// longer are. Only what a host reads changes: a loop has straightened the maps itself, so what
/// decides about it remains what was measured at first.
void ReviewLoops(const MapState& state, const PassMap& passes, LoopLedger& ledger,
                 const LoopOptions& options);

/// Measures accepted loops along a tie between aligned images where that is more certain than
/// their objects: from the match camera along its pass to the tie, across, and along the other pass
/// to the query camera. `scale`: metres per odometry metre.
void MeasureByViews(const MapState& state, const std::vector<ViewTie>& ties, double scale,
                    const OdometryNoise& noise, LoopLedger& ledger);

/// How much worse or better the odometry is than `options.odometry` says, by the accepted loops;
/// factors of one where there is none or `options.learn_odometry` is off.
OdometryFactors LearnOdometry(const MapState& state, const LoopLedger& ledger, double scale,
                              const LoopOptions& options);

}  // namespace sslcd
