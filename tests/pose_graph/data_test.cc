// SPDX-License-Identifier: BSD-3-Clause
// The public graphs and their known answers.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "formats/g2o.h"
#include "formats/text_rows.h"
#include "pose_graph_world.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

class PublicGraphs : public testing::Test {
 protected:
  void SetUp() override {
    const char* root = std::getenv("SSLCD_DATA_DIR");
    data_ = root != nullptr
                ? std::string(root)
                : (std::filesystem::path(__FILE__).parent_path() / "../../../shared/data")
                      .lexically_normal()
                      .string();
    if (!std::filesystem::is_directory(data_ + "/g2o"))
      GTEST_SKIP() << "skipped: no data at " << data_;
  }
  std::string data_;
};

TEST_F(PublicGraphs, KnownMinima) {
  const std::pair<const char*, double> minima[] = {{"sphere2500", 1351.40},
                                                   {"parking-garage", 1.26838}};
  for (const auto& [name, minimum] : minima) {
    PoseGraph graph = ReadG2o(data_ + "/g2o/" + name + ".g2o").graph;
    const PoseGraphSummary summary = SolvePoseGraph(graph, {});
    EXPECT_TRUE(summary.converged);
    EXPECT_NEAR(summary.final_chi2, minimum, 5e-6 * minimum) << name;
  }
}

TEST_F(PublicGraphs, FalseLoopsOfKitti) {
  const std::string folder = data_ + "/kitti-libviso2-posegraphs/kitti_";
  if (!std::filesystem::exists(folder + "00_odom.g2o"))
    GTEST_SKIP() << "skipped: no data at " << folder;
  RobustPoseGraphOptions options;
  options.graph.freedom = PoseFreedom::kPlanar;
  options.graph.gravity = GravityFrame::FromUp(Vec3(0, 0, 1));
  for (const std::string sequence : {"00", "05"}) {
    std::vector<Pose> truth;
    for (const auto& vertex : ReadG2o(folder + sequence + "_GT.g2o").graph.vertices)
      truth.push_back(vertex.T_world_vertex);
    std::set<std::pair<int, int>> true_pairs;
    for (TextRows row(folder + sequence + "_alpha_0.15_GT_LC.txt"); row.Next();)
      true_pairs.insert({row.Integer(0), row.Integer(1)});

    PoseGraph only_true = ReadG2o(folder + sequence + "_odom_GT_LC.g2o").graph;
    SolvePoseGraph(only_true, options.graph);
    PoseGraph graph = ReadG2o(folder + sequence + "_alpha_0.15.g2o").graph;
    const RobustPoseGraphSummary summary = SolveRobust(graph, options);
    int true_kept = 0, false_kept = 0;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      if (!graph.edges[e].loop || summary.edge_weight[e] == 0) continue;
      ++(true_pairs.count({graph.edges[e].from, graph.edges[e].to}) ? true_kept : false_kept);
    }
    EXPECT_LE(AteRmse(graph, truth), 1.1 * AteRmse(only_true, truth)) << sequence;
    EXPECT_GE(true_kept, 0.9 * static_cast<double>(true_pairs.size())) << sequence;
    EXPECT_EQ(false_kept, 0) << sequence;
  }
}

}  // namespace
}  // namespace sslcd
