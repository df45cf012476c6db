// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pose_graph/pose_graph.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "pose_graph/chordal.h"
#include "pose_graph/index.h"
#include "pose_graph_world.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double Distance(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

PoseGraph::Edge Edge(int from, int to, const Pose& T, bool loop = false) {
  PoseGraph::Edge edge;
  edge.from = from;
  edge.to = to;
  edge.T_from_to = T;
  edge.loop = loop;
  return edge;
}

// A ring without contradictions, whose vertices were pushed about.
struct Ring {
  PoseGraph graph;
  std::vector<Pose> truth;

  explicit Ring(int count, double disturbance = 0.2) {
    PoseNoise noise(1);
    for (int i = 0; i < count; ++i) {
      truth.push_back(Pose::RotZ(2 * M_PI * i / count) * Pose::Trans(10, 0, 0) *
                      Pose::RotX(0.1 * i));
      Vec6 push;
      for (int k = 0; k < 6; ++k) push[k] = i == 0 ? 0. : disturbance * noise.Normal();
      graph.vertices.push_back({10 + i, truth[i] * Pose::Exp(push)});
    }
    for (int i = 0; i < count; ++i) {
      const int j = (i + 1) % count;
      graph.edges.push_back(Edge(10 + i, 10 + j, truth[i].inverse() * truth[j], j == 0));
    }
  }
};

PoseGraphWorld NoisyWorld(unsigned seed = 1) {
  PoseGraphWorldOptions options;
  options.seed = seed;
  options.keyframes = 240;
  options.loops = 20;
  return MakePoseGraphWorld(options);
}

TEST(PoseGraphSolver, FindsTheTruthFromAnyStart) {
  for (const PoseGraphStart start :
       {PoseGraphStart::kAuto, PoseGraphStart::kGiven, PoseGraphStart::kChordal}) {
    Ring ring(12);
    PoseGraphOptions options;
    options.start = start;
    options.tolerance = 1e-12;
    const PoseGraphSummary summary = SolvePoseGraph(ring.graph, options);
    EXPECT_TRUE(summary.usable);
    EXPECT_TRUE(summary.converged) << summary.message;
    EXPECT_EQ(summary.components, 1);
    EXPECT_GT(summary.initial_chi2, 1);
    EXPECT_LT(summary.final_chi2, 1e-10);
    EXPECT_NEAR(Chi2(ring.graph), summary.final_chi2, 1e-12);
    for (std::size_t i = 0; i < ring.truth.size(); ++i)
      EXPECT_LT(Distance(ring.graph.vertices[i].T_world_vertex, ring.truth[i]), 1e-5);
  }
}

TEST(PoseGraphSolver, ChordalStartSavesGraphsFarFromLinear) {
  Ring ring(60, 2.);
  PoseGraphOptions options;
  const PoseGraphSummary summary = SolvePoseGraph(ring.graph, options);
  EXPECT_TRUE(summary.chordal);
  EXPECT_LT(summary.final_chi2, 1e-6);
}

TEST(PoseGraphSolver, ChordalStartIsExactWithoutNoise) {
  const Ring ring(30, 1.);
  const PoseGraphIndex index = IndexPoseGraph(ring.graph);
  std::vector<bool> anchored(30);
  anchored[0] = true;
  const auto poses = ChordalStart(ring.graph, index.ends, std::vector<double>(30, 1.), anchored);
  ASSERT_TRUE(poses.has_value());
  for (std::size_t i = 0; i < ring.truth.size(); ++i)
    EXPECT_LT(Distance((*poses)[i], ring.truth[i]), 1e-8);
}

TEST(PoseGraphSolver, MinimumHasNoWayDown) {
  PoseGraphWorld world = NoisyWorld();
  PoseGraphOptions options;
  options.tolerance = 1e-14;
  ASSERT_TRUE(SolvePoseGraph(world.graph, options).usable);
  const double chi2 = Chi2(world.graph);
  PoseNoise noise(9);
  for (int k = 0; k < 50; ++k) {
    PoseGraph moved = world.graph;
    Vec6 step;
    for (int i = 0; i < 6; ++i) step[i] = 1e-3 * noise.Normal();
    Pose& T = moved.vertices[1 + static_cast<int>(noise.Uniform(0, 239))].T_world_vertex;
    T = T * Pose::Exp(step);
    EXPECT_GT(Chi2(moved), chi2);
  }
}

TEST(PoseGraphSolver, FixedVerticesStay) {
  Ring ring(8);
  ring.graph.vertices[3].fixed = ring.graph.vertices[5].fixed = true;
  const PoseGraph before = ring.graph;
  ASSERT_TRUE(SolvePoseGraph(ring.graph, {}).usable);
  for (const int i : {3, 5})
    EXPECT_EQ(Distance(ring.graph.vertices[i].T_world_vertex, before.vertices[i].T_world_vertex),
              0);
  EXPECT_GT(Distance(ring.graph.vertices[0].T_world_vertex, before.vertices[0].T_world_vertex),
            1e-3)
      << "the gauge is the fixed vertices', not the first one's";
}

TEST(PoseGraphSolver, AllFixed) {
  Ring ring(5);
  for (auto& vertex : ring.graph.vertices) vertex.fixed = true;
  const PoseGraphSummary summary = SolvePoseGraph(ring.graph, {});
  EXPECT_TRUE(summary.usable);
  EXPECT_EQ(summary.initial_chi2, summary.final_chi2);
}

TEST(PoseGraphSolver, PartsHaveTheirOwnGauge) {
  Ring ring(10), other(7);
  for (auto& vertex : other.graph.vertices) {
    vertex.id += 100;
    vertex.T_world_vertex = Pose::Trans(50, 0, 0) * vertex.T_world_vertex;
    ring.graph.vertices.push_back(vertex);
  }
  for (auto edge : other.graph.edges) {
    edge.from += 100;
    edge.to += 100;
    ring.graph.edges.push_back(edge);
  }
  ring.graph.vertices.push_back({999, Pose::Trans(1, 1, 1)});  // alone
  const Pose first = ring.graph.vertices[10].T_world_vertex;
  const PoseGraphSummary summary = SolvePoseGraph(ring.graph, {});
  EXPECT_TRUE(summary.usable);
  EXPECT_EQ(summary.components, 3);
  EXPECT_LT(summary.final_chi2, 1e-6);
  EXPECT_EQ(Distance(ring.graph.vertices[10].T_world_vertex, first), 0);
  EXPECT_EQ(Distance(ring.graph.vertices[17].T_world_vertex, Pose::Trans(1, 1, 1)), 0);
}

TEST(PoseGraphSolver, EdgesOfNoWeightDoNotCount) {
  Ring ring(10);
  ring.graph.edges.push_back(Edge(10, 15, Pose::Trans(100, 0, 0), true));
  std::vector<double> weights(11, 1.);
  weights[10] = 0;
  const PoseGraphSummary summary = SolvePoseGraph(ring.graph, {}, weights);
  EXPECT_LT(summary.final_chi2, 1e-6);
  EXPECT_NEAR(Chi2(ring.graph, weights), summary.final_chi2, 1e-12);
  EXPECT_GT(Chi2(ring.graph), 1000);
}

TEST(PoseGraphSolver, LoopToTheFirstVertexAndTwoAtOnce) {
  Ring ring(10);
  ring.graph.edges.push_back(Edge(15, 10, ring.truth[5].inverse() * ring.truth[0], true));
  ring.graph.edges.push_back(Edge(10, 15, ring.truth[0].inverse() * ring.truth[5], true));
  const PoseGraphSummary summary = SolvePoseGraph(ring.graph, {});
  EXPECT_TRUE(summary.converged);
  EXPECT_LT(summary.final_chi2, 1e-6);
  EXPECT_LT(Distance(ring.graph.vertices[5].T_world_vertex, ring.truth[5]), 1e-4);
}

TEST(PoseGraphSolver, UprightKeepsWhatGravityTells) {
  PoseGraphWorld world = NoisyWorld();
  const Vec3 up(0, 0, 1);
  for (const PoseFreedom freedom : {PoseFreedom::kUpright, PoseFreedom::kPlanar}) {
    PoseGraph graph = world.graph;
    PoseGraphOptions options;
    options.freedom = freedom;
    options.gravity = GravityFrame::FromUp(up);
    const PoseGraphSummary summary = SolvePoseGraph(graph, options);
    EXPECT_TRUE(summary.converged) << summary.message;
    double moved = 0;
    for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
      const Pose &before = world.graph.vertices[i].T_world_vertex,
                 &after = graph.vertices[i].T_world_vertex;
      moved = std::max(moved, (before.translation() - after.translation()).norm());
      EXPECT_NEAR((before.so3().inverse() * up - after.so3().inverse() * up).norm(), 0, 1e-9);
      if (freedom == PoseFreedom::kPlanar) {
        EXPECT_NEAR(before.translation().z(), after.translation().z(), 1e-9);
      }
    }
    EXPECT_GT(moved, 0.1);
  }
}

TEST(PoseGraphSolver, SameBytesEveryTime) {
  const PoseGraphWorld world = NoisyWorld();
  PoseGraph a = world.graph, b = world.graph;
  SolvePoseGraph(a, {});
  SolvePoseGraph(b, {});
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    EXPECT_EQ(std::memcmp(a.vertices[i].T_world_vertex.data(), b.vertices[i].T_world_vertex.data(),
                          7 * sizeof(double)),
              0);
}

TEST(PoseGraphSolver, BadGraphsAreLeftAlone) {
  const auto expect_unusable = [](const PoseGraph& graph, const std::string& reason) {
    PoseGraph after = graph;
    const PoseGraphSummary summary = SolvePoseGraph(after, {});
    EXPECT_FALSE(summary.usable);
    EXPECT_NE(summary.message.find(reason), std::string::npos) << summary.message;
    for (std::size_t i = 0; i < graph.vertices.size(); ++i)
      EXPECT_EQ(std::memcmp(after.vertices[i].T_world_vertex.data(),
                            graph.vertices[i].T_world_vertex.data(), 7 * sizeof(double)),
                0);
  };
  const PoseGraph good = Ring(5).graph;
  expect_unusable({}, "no edges");
  PoseGraph bad = good;
  bad.edges.clear();
  expect_unusable(bad, "no edges");
  bad = good;
  bad.vertices.clear();
  expect_unusable(bad, "edge 10 -> 11 leads to a vertex that is not there");
  EXPECT_THROW(Chi2(bad), Error);
  bad = good;
  bad.vertices[2].id = 10;
  expect_unusable(bad, "vertex 10 is there twice");
  bad = good;
  bad.vertices[2].T_world_vertex.translation().x() = kNaN;
  expect_unusable(bad, "vertex 12 holds NaN");
  bad = good;
  bad.edges[1].T_from_to.translation().y() = kNaN;
  expect_unusable(bad, "edge 11 -> 12 holds NaN");
  bad = good;
  bad.edges[1].information(2, 2) = kNaN;
  expect_unusable(bad, "edge 11 -> 12 holds NaN");
  for (const double value : {0., -1.}) {
    bad = good;
    bad.edges[1].information(2, 2) = value;
    expect_unusable(bad, "not positive definite");
  }
  bad = good;
  bad.edges[1].to = bad.edges[1].from;
  expect_unusable(bad, "back to its own vertex");
}

TEST(SolvePoseGraph, WeightsAndPosesThatAreNoNumbersAreRefused) {
  for (const double weight : {-1., kNaN, std::numeric_limits<double>::infinity()}) {
    Ring ring(5);
    const PoseGraphSummary summary = SolvePoseGraph(ring.graph, {}, {1, weight});
    EXPECT_FALSE(summary.usable);
    EXPECT_NE(summary.message.find("weight"), std::string::npos);
  }
  Ring ring(5);
  ring.graph.vertices[1].T_world_vertex = Pose::Trans(1e160, 0, 0);
  PoseGraphOptions options;
  options.start = PoseGraphStart::kGiven;
  const PoseGraphSummary summary = SolvePoseGraph(ring.graph, options);
  EXPECT_FALSE(summary.usable);
  EXPECT_NE(summary.message.find("overflow"), std::string::npos);
}

}  // namespace
}  // namespace sslcd
