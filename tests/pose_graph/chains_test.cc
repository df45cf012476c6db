// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/chains.h"

#include <gtest/gtest.h>

#include "pose_graph/index.h"
#include "pose_graph/tree.h"
#include "pose_graph_world.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

double WorstDistance(const PoseGraph& a, const PoseGraph& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    const Pose difference = a.vertices[i].T_world_vertex.inverse() * b.vertices[i].T_world_vertex;
    worst = std::max(worst, difference.Log().norm());
  }
  return worst;
}

// The same result with and without chains, up to nonlinearity.
TEST(CondensedGraph, SolvesAsTheWholeGraph) {
  PoseGraphWorldOptions options;
  options.keyframes = 240;
  options.loops = 6;
  options.step_sigma_m = 0.005;
  options.step_sigma_rad = 0.0003;
  options.loop_sigma_m = 0.01;
  PoseGraph whole = MakePoseGraphWorld(options).graph;
  std::swap(whole.edges[30].from, whole.edges[30].to);  // some odometry may be measured backwards
  whole.edges[30].T_from_to = whole.edges[30].T_from_to.inverse();
  PoseGraph expanded = whole;
  const PoseGraph before = whole;
  CondensedGraph condensed(expanded, IndexPoseGraph(expanded).ends);
  EXPECT_LE(condensed.graph().vertices.size(), 13u);
  SolvePoseGraph(condensed.graph(), {});
  condensed.Expand(expanded);
  SolvePoseGraph(whole, {});
  EXPECT_GT(WorstDistance(before, whole), 0.05);
  EXPECT_LT(WorstDistance(expanded, whole), 0.002);
  EXPECT_NEAR(Chi2(expanded), Chi2(whole), 0.01 * Chi2(whole));
}

TEST(CondensedGraph, UnsolvedItExpandsToTheChainsOwnGeometry) {
  PoseGraphWorldOptions options;
  options.keyframes = 60;
  options.loops = 3;
  PoseGraph graph = MakePoseGraphWorld(options).graph;
  const PoseGraph before = graph;
  const CondensedGraph condensed(graph, IndexPoseGraph(graph).ends);
  condensed.Expand(graph);
  EXPECT_LT(WorstDistance(before, graph), 1e-9);
}

// Parts without loops, a lone vertex, a trusted ring that nothing else touches.
TEST(CondensedGraph, OddParts) {
  PoseGraph graph;
  for (int i = 0; i < 8; ++i) graph.vertices.push_back({i, Pose::Trans(i, 0, 0)});
  const auto join = [&graph](int from, int to) {
    PoseGraph::Edge edge;
    edge.from = from;
    edge.to = to;
    edge.T_from_to = Pose::Trans(to - from, 0, 0);
    graph.edges.push_back(edge);
  };
  join(0, 1);
  join(1, 2);
  join(4, 5);
  join(5, 6);
  join(6, 4);  // 3 and 7 are alone
  const PoseGraph before = graph;
  CondensedGraph condensed(graph, IndexPoseGraph(graph).ends);
  EXPECT_EQ(condensed.graph().vertices.size(), 4u);
  SolvePoseGraph(condensed.graph(), {});
  condensed.Expand(graph);
  EXPECT_LT(WorstDistance(before, graph), 1e-9);
}

TEST(TrustedTree, IsTheOdometry) {
  PoseGraphWorldOptions options;
  options.keyframes = 120;
  options.loops = 10;
  options.false_loops = 10;
  const PoseGraphWorld world = MakePoseGraphWorld(options);
  const PoseGraphIndex index = IndexPoseGraph(world.graph);
  const TrustedTree tree(world.graph, index.ends);
  for (std::size_t v = 0; v < tree.poses().size(); ++v)
    EXPECT_LT((tree.poses()[v].inverse() * world.graph.vertices[v].T_world_vertex).Log().norm(),
              1e-9);
  for (std::size_t e = 0; e < index.ends.size(); ++e) {
    const auto [from, to] = index.ends[e];
    const double disagreement = tree.Disagreement(world.graph.edges[e], from, to);
    if (!world.graph.edges[e].loop) {
      EXPECT_NEAR(disagreement, 0, 1e-9);
    } else if (world.is_false[e]) {
      EXPECT_GT(disagreement, 100);
    } else {
      EXPECT_LT(disagreement, 25) << "chi2 with 6 degrees of freedom";
    }
  }
}

TEST(Components, CountsFromZeroInVertexOrder) {
  const std::vector<std::pair<int, int>> ends = {{4, 2}, {1, 3}, {3, 0}};
  EXPECT_EQ(Components(6, ends), (std::vector<int>{0, 0, 1, 0, 1, 2}));
  EXPECT_EQ(Components(6, ends, {true, true, false}), (std::vector<int>{0, 1, 2, 1, 2, 3}));
  EXPECT_EQ(Components(0, {}), std::vector<int>());
}

}  // namespace
}  // namespace sslcd
