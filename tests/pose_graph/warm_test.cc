// SPDX-License-Identifier: BSD-3-Clause
// SolveRobust from where a former solve ended: cheap where little is new, from the start otherwise.
#include <gtest/gtest.h>

#include "core/math.h"
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
  RobustPoseGraphSummary SolveWithMore(int count, const RobustPoseGraphOptions& options = {}) {
    PoseGraph graph = world_.graph;
    std::vector<double> kept = kept_;
    for (int i = 0; i < count; ++i) {
      AddLoop(graph, 30, 110, i % 2 == 0 ? 0.6 : -0.6);
      kept.push_back(1);
    }
    return SolveRobust(graph, options, kept);
  }
  // With exact true loops, `total` loops in all.
  void FillUpWithTrueLoops(std::size_t total) {
    for (std::size_t loops = 8; loops < total; ++loops) {
      AddLoop(world_.graph, 60, 140, 0);
      world_.graph.edges.back().T_from_to = world_.truth[60].inverse() * world_.truth[140];
    }
    kept_ = SolveRobust(world_.graph, {}).edge_weight;
  }

  PoseGraphWorld world_;
  std::vector<double> kept_;
};

TEST_F(WarmStart, NothingNewIsDecidedAtOnceAndAsBefore) {
  const RobustPoseGraphSummary warm = SolveWithMore(0);
  EXPECT_EQ(warm.rounds, 0);
  EXPECT_EQ(warm.edge_weight, kept_);
}

TEST_F(WarmStart, TwoLoopsThatAreRefusedAreDecidedFromTheStart) {
  const RobustPoseGraphSummary cold = SolveWithMore(1);
  EXPECT_GT(cold.rounds, 0);
  EXPECT_EQ(cold.loops_kept, 7);
  EXPECT_EQ(cold.loops_refused, 2);
}

TEST_F(WarmStart, OfManyLoopsAFiftiethMayBeRefused) {
  FillUpWithTrueLoops(98);
  EXPECT_EQ(SolveWithMore(2).rounds, 0) << "2 of 100";
  EXPECT_GT(SolveWithMore(3).rounds, 0) << "3 of 101";
}

// Only the misfit that new loops add counts: here odometry has already been bent by more.
TEST_F(WarmStart, WhatFormerLoopsHaveBentIsNotHeldAgainstNewOnes) {
  RobustPoseGraphOptions options;
  options.drift_factor = 1;
  options.inlier_probability = 0.98;
  std::vector<double> trusted;
  for (const auto& edge : world_.graph.edges) trusted.push_back(edge.loop ? 0 : 1);
  ASSERT_GT(Chi2(world_.graph, trusted), Chi2Quantile(options.inlier_probability, 6));
  EXPECT_EQ(SolveWithMore(0, options).rounds, 0);
}

TEST_F(WarmStart, FromPosesThatCannotBeSolvedItStartsAgain) {
  PoseGraph lost = world_.graph;
  for (std::size_t v = 1; v < lost.vertices.size(); ++v)  // in sigmas this is infinite
    lost.vertices[v].T_world_vertex.translation() *= 5e306;
  const RobustPoseGraphSummary summary = SolveRobust(lost, {}, kept_);
  ASSERT_TRUE(summary.graph.usable);
  EXPECT_GT(summary.rounds, 0);
  EXPECT_EQ(summary.edge_weight, kept_);
  EXPECT_NEAR(AteRmse(lost, world_.truth), AteRmse(world_.graph, world_.truth), 1e-6);
}

TEST_F(WarmStart, WeightsOfAnotherGraphAreIgnored) {
  PoseGraph graph = world_.graph;
  kept_.pop_back();
  EXPECT_GT(SolveRobust(graph, {}, kept_).rounds, 0);
}

}  // namespace
}  // namespace sslcd
