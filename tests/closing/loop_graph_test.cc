// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_graph.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

namespace sslcd {
namespace {

// Straight ahead, a frame every metre; the world is 1.1 times the odometry.
void DriveOn(FrameStore& frames, int end, std::optional<StepUncertainty> first = {}) {
  for (int i = frames.size(); i <= end; ++i) {
    FrameRecord record;
    record.frame = 100 + i;
    record.T_odom_cam = Pose::Trans(0, 0, i);
    record.T_world_cam = Pose::Trans(0, 0, 1.1 * i);
    frames.Append(record, std::exchange(first, std::nullopt));
  }
}

FrameStore Line() {
  FrameStore frames;
  DriveOn(frames, 40);
  return frames;
}

LoopClosure Closure(LoopDecision decision, double variance) {
  LoopClosure closure;
  closure.decision = decision;
  closure.T_match_query = Pose::Trans(1, 0, 2);
  closure.covariance *= variance;
  return closure;
}

const Vec3 kUp(0, -1, 0);

TEST(BuildLoopGraph, KeyframesByPathAndTheEndsOfLoops) {
  const FrameStore frames = Line();
  const LoopClosure closure = Closure(LoopDecision::kAccepted, 0.25);
  LoopOptions options;
  options.keyframe_m = 10;
  const LoopGraph loop = BuildLoopGraph(frames, {{3, 37, &closure}}, 1.1, kUp, options, {});
  EXPECT_EQ(loop.keyframes, (std::vector<int>{0, 3, 10, 20, 30, 37, 40}));
  ASSERT_EQ(loop.graph.vertices.size(), loop.keyframes.size());
  for (std::size_t k = 0; k < loop.keyframes.size(); ++k) {
    EXPECT_EQ(loop.graph.vertices[k].id, loop.keyframes[k]);
    EXPECT_EQ(loop.graph.vertices[k].fixed, k == 0);
    EXPECT_NEAR(loop.graph.vertices[k].T_world_vertex.translation().z(), 1.1 * loop.keyframes[k],
                1e-12);
  }
}

TEST(BuildLoopGraph, MetricOdometryBetweenKeyframesThenTheLoops) {
  const FrameStore frames = Line();
  const LoopClosure kept = Closure(LoopDecision::kAccepted, 0.25),
                    refused = Closure(LoopDecision::kAmbiguous, 4);
  LoopOptions options;
  options.keyframe_m = 10;
  const LoopGraph loop =
      BuildLoopGraph(frames, {{0, 40, &kept}, {10, 30, &refused}}, 1.1, kUp, options, {});
  ASSERT_EQ(loop.first_loop, 4u);
  ASSERT_EQ(loop.graph.edges.size(), 6u);
  EXPECT_EQ(loop.kept_before, (std::vector<double>{1, 1, 1, 1, 1, 0}));
  for (std::size_t e = 0; e < loop.first_loop; ++e) {
    EXPECT_FALSE(loop.graph.edges[e].loop);
    EXPECT_NEAR(loop.graph.edges[e].T_from_to.translation().z(), 11, 1e-12);
  }
  const PoseGraph::Edge& edge = loop.graph.edges[4];
  EXPECT_TRUE(edge.loop);
  EXPECT_EQ(edge.from, 0) << "the match camera";
  EXPECT_EQ(edge.to, 40) << "the query camera";
  EXPECT_TRUE(edge.T_from_to.translation().isApprox(Vec3(1, 0, 2)));
  EXPECT_NEAR(edge.information(0, 0), 4, 1e-12) << "the covariance's inverse";
  EXPECT_NEAR(loop.graph.edges[5].information(5, 5), 0.25, 1e-12);
}

TEST(BuildLoopGraph, OdometryOfALongerStepIsLessCertain) {
  const FrameStore frames = Line();
  LoopOptions options;
  options.keyframe_m = 10;
  const LoopClosure closure = Closure(LoopDecision::kAccepted, 1);
  const PoseGraph graph = BuildLoopGraph(frames, {{3, 40, &closure}}, 1.1, kUp, options, {}).graph;
  ASSERT_EQ(graph.edges[0].to, 3);
  ASSERT_EQ(graph.edges[1].to, 10);
  EXPECT_GT(graph.edges[0].information(0, 0), graph.edges[1].information(0, 0));
}

TEST(WithRefinedSteps, OnlyStepsBetweenRefinedFramesOfOnePartAreReplaced) {
  FrameStore frames;
  DriveOn(frames, 14);
  DriveOn(frames, 35, StepUncertainty{true, 0, 0});  // odometry was lost before frame 15
  frames.MarkRefined();
  DriveOn(frames, 60);
  LoopOptions options;
  options.keyframe_m = 10;
  const LoopClosure closure = Closure(LoopDecision::kAccepted, 1);
  const LoopGraph graph = BuildLoopGraph(frames, {{0, 60, &closure}}, 1., kUp, options, {});
  const PoseGraph refined = WithRefinedSteps(frames, graph);
  ASSERT_EQ(refined.edges.size(), graph.graph.edges.size());
  std::vector<int> replaced;
  for (std::size_t k = 0; k < refined.edges.size(); ++k) {
    const PoseGraph::Edge &before = graph.graph.edges[k], &after = refined.edges[k];
    EXPECT_EQ(before.information, after.information);
    if (before.T_from_to.matrix() == after.T_from_to.matrix()) continue;
    replaced.push_back(after.to);
    EXPECT_NEAR(after.T_from_to.translation().z(), 1.1 * (after.to - after.from), 1e-9);
  }
  EXPECT_EQ(graph.keyframes, (std::vector<int>{0, 10, 14, 15, 25, 35, 45, 55, 60}));
  EXPECT_EQ(replaced, (std::vector<int>{10, 14, 25, 35}));
}

}  // namespace
}  // namespace sslcd
