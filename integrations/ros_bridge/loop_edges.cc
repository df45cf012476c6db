// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/loop_edges.h"

namespace sslcd::ros_bridge {

std::vector<LoopEdge> Update(const std::vector<LoopEdge>& changed, std::map<int, LoopEdge>& loops) {
  std::vector<LoopEdge> told;
  for (const LoopEdge& edge : changed) {
    if (edge.accepted) {
      loops[edge.id] = edge;
      told.push_back(edge);
    } else if (loops.erase(edge.id) > 0) {
      told.push_back(edge);
    }
  }
  return told;
}

}  // namespace sslcd::ros_bridge
