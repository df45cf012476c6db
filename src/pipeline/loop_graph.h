// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/loop_closure.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

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
LoopGraph BuildLoopGraph(const std::vector<FrameRecord>& frames, const std::vector<LoopEdge>& loops,
                         double scale, const Vec3& up, const LoopOptions& options);

/// How the layout around a camera moves with it: yaw about its place. Heights are the layout's own
/// and stay.
YawShift LayoutChange(const Pose& T_before, const Pose& T_now, const GravityFrame& gravity);

}  // namespace sslcd
