// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "closing/loop_ledger.h"
#include "refine/improvement.h"

namespace sslcd {

/// The answer of a run, where it is not the optimised state.
struct FinalTrajectory {
  ImprovementProbability improvement;
  bool keeps_horizontal = false;  ///< the horizontal positions are those of odometry
  std::optional<MapState> state;  ///< none: the optimised state is the answer
};

/// Decides what to believe after a refinement: a part of the optimised trajectory replaces that of
/// the odometry only where it is nearer to the truth with RefineOptions::least_probability. If the
/// cameras of the odometry stay level, loops alone correct its heights (HeightsByLoops). If they do
/// not turn about the vertical (MayBeUp), the odometry stays. The first four arguments are those of
/// OptimiseMap(), after it; `noise` is what tilt is compared with.
FinalTrajectory ChooseTrajectory(const MapState& state, double log_scale,
                                 const LoopEvidence& evidence, const WholeMapOptions& options,
                                 const LoopLedger& loops, const OdometryNoise& noise);

}  // namespace sslcd
