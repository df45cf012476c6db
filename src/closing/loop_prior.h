// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/pass_layout.h"
#include "closing/path_graph.h"
#include "loop/pose_tracks.h"
#include "sslcd/closing/options.h"

namespace sslcd {

/// The prior log odds of a pose: the likelihood of the required odometry error over the path with
/// shortcuts, against poses uniformly distributed over the searched map, like LayoutFit::evidence.
/// Keeps references to passes, layout and index.
PoseTracks::Prior OdometryPrior(const PassMap& passes, const PathGraph::Distances& distances,
                                const PassLayout& local, const LayoutIndex& index,
                                const LoopPriorOptions& options);

}  // namespace sslcd
