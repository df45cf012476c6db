// SPDX-License-Identifier: BSD-3-Clause
// The robust solver on the graph of tests/data, which every copy of the repository has.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "formats/g2o.h"
#include "pose_graph_world.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

PoseGraph Read(const std::string& name) {
  const std::filesystem::path tests = std::filesystem::path(__FILE__).parent_path().parent_path();
  return ReadG2o((tests / "data" / name).string()).graph;
}

TEST(MadeUpGraph, FalseLoopsAreRefusedAndTrueOnesKept) {
  PoseGraph graph = Read("loops.g2o");
  std::map<int, Pose> truth;
  std::vector<Pose> path;
  for (const PoseGraph::Vertex& vertex : Read("loops_truth.g2o").vertices) {
    truth[vertex.id] = vertex.T_world_vertex;
    path.push_back(vertex.T_world_vertex);
  }
  EXPECT_NEAR(AteRmse(graph, path), 1.1027, 1e-3) << "the data is another";
  const RobustPoseGraphSummary summary = SolveRobust(graph, {});
  ASSERT_TRUE(summary.graph.usable);
  int kept_true = 0, kept_false = 0, loops = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const PoseGraph::Edge& edge = graph.edges[e];
    if (!edge.loop) continue;
    ++loops;
    const Pose off = edge.T_from_to.inverse() * truth[edge.from].inverse() * truth[edge.to];
    const bool is_true = off.translation().norm() < 1;  // the noise is 0.1 m per axis
    if (summary.edge_weight[e] > 0) ++(is_true ? kept_true : kept_false);
  }
  EXPECT_EQ(loops, 48);
  EXPECT_EQ(kept_false, 0);
  EXPECT_EQ(kept_true, 32);
  EXPECT_LE(AteRmse(graph, path), 1.15 * 0.1799);
}

}  // namespace
}  // namespace sslcd
