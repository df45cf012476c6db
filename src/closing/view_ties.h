// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "closing/path_graph.h"
#include "core/frame_store.h"
#include "sslcd/closing/options.h"
#include "sslcd/closing/view_aligner.h"
#include "sslcd/core/loop_closure.h"

namespace sslcd {

/// Ties cameras of different passes whose images show the same ground, wherever odometry or closed
/// loops say roughly where they stand. Loops of objects are right to some decimetres, since cuboids
/// lack the same side on a whole pass; images are right to some centimetres, once it is known where
/// to look. `path`: the accepted loops are its shortcuts. In order of the later camera, one tie
/// each at most. Answers that are not finite, or whose covariance is singular, are left out.
std::vector<ViewTie> TieViews(const FrameStore& frames, const PathGraph& path,
                              const ViewAligner& align, const LoopOptions& options);

/// The ties that the trajectory, adjusted with them, agrees with: it does not with wrong ones.
std::vector<ViewTie> AgreeingTies(const std::vector<ViewTie>& ties, const FrameStore& frames);

/// How much path such an odometry goes until it is likely to be `off_m` off. [m]
double PathUntilOff(const OdometryNoise& noise, double off_m);

}  // namespace sslcd
