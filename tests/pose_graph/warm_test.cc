// SPDX-License-Identifier: BSD-3-Clause
// SolveRobust from where a former solve ended: cheap where little is new, from the start otherwise.
#include <gtest/gtest.h>

#include "pose_graph_world.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

// Two laps with seven true loops, solved; a false one makes the first solve take several rounds.
class WarmStart : public testing::Test {
 protected:
  void SetUp() override {
    PoseGraphWorldOptions options;
    options.keyframes = 240;
    options.loops = 0;
    world_ = MakePoseGraphWorld(options);
    for (const int i : {0, 30, 30, 30, 30, 30, 60}) AddLoop(world_.graph, i, 80 + i, 0);
    AddLoop(world_.graph, 20, 180, 2.);
    const RobustPoseGraphSummary cold = SolveRobust(world_.graph, {});
    ASSERT_GT(cold.rounds, 0);
    ASSERT_EQ(cold.loops_kept, 7);
    kept_ = cold.edge_weight;
  }
  void AddLoop(PoseGraph& graph, int from, int to, double error_m) {
    PoseNoise noise(static_cast<unsigned>(from + 1000 * to));
    const Pose T = world_.truth[from].inverse() * Pose::Trans(error_m, 0, 0) * world_.truth[to];
    graph.edges.push_back(noise.Measure(from, to, T, 0.05, 0.005));
    graph.edges.back().loop = true;
  }
  // With `count` more false loops, which contradict five true ones and each other.
  RobustPoseGraphSummary SolveWithMore(int count) {
    PoseGraph graph = world_.graph;
    std::vector<double> kept = kept_;
    for (int i = 0; i < count; ++i) {
      AddLoop(graph, 30, 110, i % 2 == 0 ? 0.6 : -0.6);
      kept.push_back(1);
    }
    return SolveRobust(graph, {}, kept);
  }

  PoseGraphWorld world_;
  std::vector<double> kept_;
};

TEST_F(WarmStart, NothingNewIsDecidedAtOnceAndAsBefore) {
  const RobustPoseGraphSummary warm = SolveWithMore(0);
  EXPECT_EQ(warm.rounds, 0);
  EXPECT_EQ(warm.edge_weight, kept_);
}

TEST_F(WarmStart, OneLoopThatIsRefusedIsStillLittle) {
  const RobustPoseGraphSummary warm = SolveWithMore(1);
  EXPECT_EQ(warm.rounds, 0);
  EXPECT_EQ(warm.loops_kept, 7);
  EXPECT_EQ(warm.loops_refused, 2);
}

TEST_F(WarmStart, TwoThatAreRefusedAreDecidedFromTheStart) {
  const RobustPoseGraphSummary cold = SolveWithMore(2);
  EXPECT_GT(cold.rounds, 0);
  EXPECT_EQ(cold.loops_kept, 7);
  EXPECT_EQ(cold.loops_refused, 3);
}

TEST_F(WarmStart, WeightsOfAnotherGraphAreIgnored) {
  PoseGraph graph = world_.graph;
  kept_.pop_back();
  EXPECT_GT(SolveRobust(graph, {}, kept_).rounds, 0);
}

}  // namespace
}  // namespace sslcd
