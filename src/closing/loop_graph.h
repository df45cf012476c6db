// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/frame_store.h"
#include "sslcd/closing/options.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// A turn that makes a keyframe of the pose graph and of the adjustment after a loop. [rad]
inline constexpr double kGraphKeyframeRad = 0.5;

/// A loop between two frames, by their indices.
struct LoopEdge {
  int match = 0, query = 0;
  const LoopClosure* closure = nullptr;
};

/// The pose graph of paper IV-D, Eqs. 20 and 21, with the loops that these lack.
struct LoopGraph {
  /// the vertices: indices of frames, ascending; ends of loops are among them
  std::vector<int> keyframes;
  /// odometry between keyframes, then the loops in the order given
  PoseGraph graph;
  std::size_t first_loop = 0;       ///< among the edges
  std::vector<double> kept_before;  ///< per edge, for SolveRobust
};

/// `scale`: metres per odometry metre. `up`: unit vector against gravity. [world]
LoopGraph BuildLoopGraph(const FrameStore& frames, const std::vector<LoopEdge>& loops, double scale,
                         const Vec3& up, const LoopOptions& options);

}  // namespace sslcd
