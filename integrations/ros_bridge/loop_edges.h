// SPDX-License-Identifier: BSD-3-Clause
// Loops as edges of a pose graph.
#pragma once

#include <map>
#include <vector>

#include "ros_bridge/messages.h"
#include "sslcd/core/pose.h"

namespace sslcd::ros_bridge {

/// A loop between two poses of the path.
struct LoopEdge {
  int id = 0;                            ///< LoopClosure::id
  bool accepted = false;                 ///< false: it is taken back, or was never accepted
  bool early = false;                    ///< LoopClosure::early
  int match_frame = 0, query_frame = 0;  ///< PathPose::frame
  Stamp match = 0, query = 0;            ///< stamps of these
  RelativePose measured;                 ///< T_match_query of the base, metric
};

/// Brings the accepted loops up to date. Returns those that are new, measured again or taken back.
std::vector<LoopEdge> Update(const std::vector<LoopEdge>& changed, std::map<int, LoopEdge>& loops);

}  // namespace sslcd::ros_bridge
