// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/loop_edges.h"

#include <gtest/gtest.h>

namespace sslcd::ros_bridge {
namespace {

LoopEdge Edge(int id, bool accepted, double x = 0) {
  LoopEdge edge;
  edge.id = id;
  edge.accepted = accepted;
  edge.measured.T_a_b = Pose::Trans(x, 0, 0);
  return edge;
}

TEST(UpdateLoops, KeepsAcceptedOnesAndTellsWhatHasChanged) {
  std::map<int, LoopEdge> loops;
  EXPECT_EQ(Update({Edge(1, true), Edge(2, false), Edge(3, true)}, loops).size(), 2u);
  EXPECT_EQ(loops.size(), 2u);
  EXPECT_TRUE(Update({}, loops).empty());

  const std::vector<LoopEdge> again = Update({Edge(3, true, 5)}, loops);
  ASSERT_EQ(again.size(), 1u) << "measured again";
  EXPECT_EQ(loops.at(3).measured.T_a_b.translation().x(), 5);

  const std::vector<LoopEdge> back = Update({Edge(1, false), Edge(2, false)}, loops);
  ASSERT_EQ(back.size(), 1u) << "a loop that was never accepted is not told";
  EXPECT_EQ(back[0].id, 1);
  EXPECT_FALSE(back[0].accepted);
  EXPECT_EQ(loops.size(), 1u);

  EXPECT_EQ(Update({Edge(2, true)}, loops).size(), 1u) << "accepted later";
}

}  // namespace
}  // namespace sslcd::ros_bridge
