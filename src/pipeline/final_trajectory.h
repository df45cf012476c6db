// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/loop_ledger.h"
#include "refine/improvement.h"

namespace sslcd {

/// Decides what to believe after a refinement: a part of the optimised trajectory replaces that of
/// the odometry only where it is nearer to the truth with RefineOptions::least_probability, or,
/// where loops join parts of the run, where this is more probable than not. If the cameras of the
/// odometry stay level, loops alone correct its heights (HeightsByLoops). If they do not turn about
/// the vertical (MayBeUp), the odometry stays. The scale is one where its horizontal positions
/// stay. The first four arguments are those of OptimiseMap(), after it; `noise` is what tilt is
/// compared with.
ImprovementProbability ChooseTrajectory(MapState& state, double& log_scale,
                                        const LoopEvidence& evidence,
                                        const WholeMapOptions& options, const LoopLedger& loops,
                                        const OdometryNoise& noise);

}  // namespace sslcd
