// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/frame_store.h"
#include "odometry/odometry_noise.h"
#include "sslcd/closing/options.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// Rotation from one keyframe of the pose graph to the next, also for the adjustment after a loop.
/// [rad]
inline constexpr double kGraphKeyframeRad = 0.5;

/// A loop between two frames, given by index.
struct LoopEdge {
  int match = 0, query = 0;
  const LoopClosure* closure = nullptr;
};

/// The pose graph of paper IV-D, Eqs. 20 and 21, including the loops that the equations lack.
struct LoopGraph {
  /// frame index of each vertex, ascending; includes the ends of loops
  std::vector<int> keyframes;
  /// odometry between keyframes, followed by the loops in the given order
  PoseGraph graph;
  std::size_t first_loop = 0;       ///< index of the first loop among the edges
  std::vector<double> kept_before;  ///< argument of SolveRobust, per edge
};

/// Builds the graph. `scale` is metres per odometry metre, `up` the unit vector against gravity in
/// the world, `factors` are on `options.odometry`.
LoopGraph BuildLoopGraph(const FrameStore& frames, const std::vector<LoopEdge>& loops, double scale,
                         const Vec3& up, const LoopOptions& options,
                         const OdometryFactors& factors);

/// The graph with the steps of the refinement between refined frames, which know more than odometry
/// and loops: a later loop bends them, but does not undo them.
PoseGraph WithRefinedSteps(const FrameStore& frames, const LoopGraph& graph);

}  // namespace sslcd
