// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/pass_map.h"
#include "closing/path_graph.h"
#include "loop/pose_tracks.h"
#include "sslcd/closing/options.h"

namespace sslcd {

/// Log odds of a pose before any object is looked at: would odometry have to be off by more than
/// the path, shortcuts taken, explains? Against poses strewn evenly over the searched map, as
/// LayoutFit::evidence is. Refers to passes, layout and index while it is used.
PoseTracks::Prior OdometryPrior(const PassMap& passes, const PathGraph::Distances& distances,
                                const PassLayout& local, const LayoutIndex& index,
                                const LoopPriorOptions& options);

}  // namespace sslcd
