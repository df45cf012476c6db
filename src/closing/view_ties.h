// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "closing/path_graph.h"
#include "core/frame_store.h"
#include "sslcd/closing/options.h"
#include "sslcd/closing/view_aligner.h"
#include "sslcd/core/loop_closure.h"

namespace sslcd {

/// Aligns images of different passes that show the same ground, with an initial guess from odometry
/// and closed loops. Loops of objects have errors of some decimetres, since a whole pass sees one
/// side of the cuboids; aligned images have errors of some centimetres. `path` has the accepted
/// loops as shortcuts. Returns at most one tie per later camera, in order. Ignores answers that are
/// not finite or have a singular covariance.
std::vector<ViewTie> TieViews(const FrameStore& frames, const PathGraph& path,
                              const ViewAligner& align, const LoopOptions& options);

/// Selects the ties that agree with the trajectory after an adjustment with them, which excludes
/// wrong ones.
std::vector<ViewTie> AgreeingTies(const std::vector<ViewTie>& ties, const FrameStore& frames);

/// The path length after which the standard deviation of this odometry is `off_m`. [m]
double PathUntilDrift(const OdometryNoise& noise, double off_m);

}  // namespace sslcd
