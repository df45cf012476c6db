// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pose_graph/pose_graph.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

#include "pose_graph_world.h"

namespace sslcd {
namespace {

struct Counts {
  int true_kept = 0, true_refused = 0, false_kept = 0, false_refused = 0;
};

Counts Count(const PoseGraphWorld& world, const RobustPoseGraphSummary& summary) {
  Counts counts;
  for (std::size_t e = 0; e < world.graph.edges.size(); ++e) {
    if (!world.graph.edges[e].loop) continue;
    const bool kept = summary.edge_weight[e] > 0;
    ++(world.is_false[e] ? (kept ? counts.false_kept : counts.false_refused)
                         : (kept ? counts.true_kept : counts.true_refused));
  }
  return counts;
}

PoseGraphWorldOptions Small() {
  PoseGraphWorldOptions options;
  options.keyframes = 240;
  options.loops = 0;
  return options;
}

// A loop `from` -> `to` that puts `to` `error_m` too far along the world's x.
void AddLoop(PoseGraphWorld& world, int from, int to, double error_m) {
  PoseNoise noise(static_cast<unsigned>(from + 1000 * to));
  PoseGraph::Edge edge = noise.Measure(
      from, to, world.truth[from].inverse() * Pose::Trans(error_m, 0, 0) * world.truth[to], 0.05,
      0.005);
  edge.loop = true;
  world.graph.edges.push_back(edge);
  world.is_false.push_back(error_m != 0);
}

PoseGraph SolvedWith(PoseGraph graph, const PoseGraphOptions& options) {
  EXPECT_TRUE(SolvePoseGraph(graph, options).usable);
  return graph;
}

TEST(RobustPoseGraph, SyntheticBars) {
  for (const int false_loops : {0, 17, 57}) {
    for (const unsigned seed : {1u, 2u, 3u}) {
      PoseGraphWorldOptions options;
      options.seed = seed;
      options.false_loops = false_loops;
      PoseGraphWorld world = MakePoseGraphWorld(options);
      const auto start = std::chrono::steady_clock::now();
      const RobustPoseGraphSummary summary = SolveRobust(world.graph, {});
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      EXPECT_TRUE(summary.graph.usable);
      EXPECT_LE(AteRmse(world.graph, world.truth), 0.5)
          << "seed " << seed << ", false loops " << false_loops;
      EXPECT_LT(seconds, 5) << "0.5 s in an optimised build on an idle machine";
      const Counts counts = Count(world, summary);
      EXPECT_EQ(counts.false_kept, 0);
      EXPECT_GE(counts.true_kept, 57);
      EXPECT_EQ(summary.loops_kept, counts.true_kept);
      EXPECT_EQ(summary.loops_refused, counts.true_refused + counts.false_refused);
    }
  }
}

TEST(RobustPoseGraph, UprightToo) {
  PoseGraphWorldOptions world_options;
  world_options.false_loops = 17;
  PoseGraphWorld world = MakePoseGraphWorld(world_options);
  for (std::size_t i = 0; i < world.truth.size();
       ++i) {  // roll and pitch known, yaw as odometry has it
    Pose& T = world.graph.vertices[i].T_world_vertex;
    const Vec3 forward = T.so3() * Vec3(1, 0, 0);
    T.so3() = lie::SO3<double>::RotZ(std::atan2(forward.y(), forward.x()));
  }
  RobustPoseGraphOptions options;
  options.graph.freedom = PoseFreedom::kUpright;
  options.graph.gravity = GravityFrame::FromUp(Vec3(0, 0, 1));
  const Counts counts = Count(world, SolveRobust(world.graph, options));
  EXPECT_EQ(counts.false_kept, 0);
  EXPECT_GE(counts.true_kept, 55);
  EXPECT_LE(AteRmse(world.graph, world.truth), 0.5);
}

TEST(RobustPoseGraph, FalseLoopsThatAgreeWithEachOther) {
  PoseGraphWorldOptions options;
  options.false_loops = 0;
  PoseGraphWorld world = MakePoseGraphWorld(options);
  for (int i = 0; i < 3; ++i) AddLoop(world, 20 + i, 320 + i, 5);  // another row, three times
  const Counts counts = Count(world, SolveRobust(world.graph, {}));
  EXPECT_EQ(counts.false_kept, 0);
  EXPECT_GE(counts.true_kept, 57);
  EXPECT_LE(AteRmse(world.graph, world.truth), 0.5);
}

TEST(RobustPoseGraph, ContradictoryLoopsAreDecidedByTheMajority) {
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  for (const double error : {0., 0., 0., 2., 2.})
    AddLoop(world, 20, 180 + static_cast<int>(world.is_false.size()) % 5, error);
  const Counts counts = Count(world, SolveRobust(world.graph, {}));
  EXPECT_EQ(counts.true_kept, 3);
  EXPECT_EQ(counts.false_kept, 0);
}

TEST(RobustPoseGraph, ACounterpartForEachLeavesAtMostOne) {
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  AddLoop(world, 20, 180, 1.);
  AddLoop(world, 20, 180, -1.);
  const RobustPoseGraphSummary summary = SolveRobust(world.graph, {});
  EXPECT_TRUE(summary.graph.usable);
  EXPECT_LE(summary.loops_kept, 1);
}

TEST(RobustPoseGraph, LoopsAreTakenBackAndComeBack) {
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  const PoseGraph odometry = world.graph;
  const auto kept = [&] {
    PoseGraph graph = world.graph;
    const auto weights = SolveRobust(graph, {}).edge_weight;
    return std::vector<double>(weights.begin() + static_cast<std::ptrdiff_t>(odometry.edges.size()),
                               weights.end());
  };
  AddLoop(world, 20, 180, 1.);
  EXPECT_EQ(kept(), (std::vector<double>{1})) << "nothing speaks against it yet";
  AddLoop(world, 21, 181, 0);
  AddLoop(world, 22, 182, 0);
  EXPECT_EQ(kept(), (std::vector<double>{0, 1, 1}));
  for (const int i : {0, 1, 2}) AddLoop(world, 23 + i, 183 + i, 1.);
  EXPECT_EQ(kept(), (std::vector<double>{1, 0, 0, 1, 1, 1}));
}

TEST(RobustPoseGraph, ACrowdOfFalseLoopsDoesNotBendTheOdometry) {
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  for (const int i : {0, 30, 60}) AddLoop(world, i, 80 + i, 0);
  std::vector<double> kept = SolveRobust(world.graph, {}).edge_weight;
  const double before = AteRmse(world.graph, world.truth);
  // all at once, from where the former solve ended
  for (int i = 0; i < 20; ++i) AddLoop(world, 5 + i, 45 + i, 4.);
  kept.resize(world.graph.edges.size(), 1.);
  const RobustPoseGraphSummary summary = SolveRobust(world.graph, {}, kept);
  const Counts counts = Count(world, summary);
  EXPECT_GT(summary.rounds, 0) << "from the start";
  EXPECT_EQ(counts.true_kept, 3);
  EXPECT_EQ(counts.false_kept, 0);
  EXPECT_NEAR(AteRmse(world.graph, world.truth), before, 1e-3);
}

TEST(RobustPoseGraph, AWarmSolveHasThePosesOfAFullOne) {
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  for (const int i : {0, 30, 60}) AddLoop(world, i, 80 + i, 0);
  std::vector<double> kept = SolveRobust(world.graph, {}).edge_weight;
  for (const int i : {1, 31, 61}) AddLoop(world, i, 80 + i, 0);
  kept.resize(world.graph.edges.size(), 1.);
  PoseGraph full = world.graph;
  const double before = AteRmse(full, PosesOf(SolvedWith(full, {})));
  const RobustPoseGraphSummary warm = SolveRobust(world.graph, {}, kept);
  EXPECT_EQ(warm.rounds, 0) << "from the former solution";
  EXPECT_EQ(warm.loops_kept, 6);
  EXPECT_LT(AteRmse(world.graph, PosesOf(SolvedWith(full, {}))), 0.02 * before);
}

TEST(RobustPoseGraph, LoopToTheFirstVertexAndTwoAtOnce) {
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  AddLoop(world, 0, 160, 0);
  AddLoop(world, 160, 0, 0);
  AddLoop(world, 0, 239, 0);
  AddLoop(world, 0, 239, 0);
  const double before = AteRmse(world.graph, world.truth);
  const RobustPoseGraphSummary summary = SolveRobust(world.graph, {});
  EXPECT_EQ(summary.loops_kept, 4);
  EXPECT_LT(AteRmse(world.graph, world.truth), before);
}

TEST(RobustPoseGraph, StartsAtTheGeometryOfTheTrustedEdgesWhateverPosesAreGiven) {
  PoseGraphWorldOptions options = Small();
  options.loops = 20;
  options.false_loops = 10;
  PoseGraphWorld world = MakePoseGraphWorld(options);
  PoseGraph astray = world.graph;
  PoseNoise noise(3);
  for (std::size_t v = 1; v < astray.vertices.size(); ++v)
    astray.vertices[v].T_world_vertex =
        Pose(lie::SO3<double>::RotZ(noise.Uniform(-M_PI, M_PI)),
             Vec3(noise.Uniform(-50, 50), noise.Uniform(-50, 50), noise.Uniform(-5, 5)));
  const RobustPoseGraphSummary summary = SolveRobust(world.graph, {});
  EXPECT_EQ(SolveRobust(astray, {}).edge_weight, summary.edge_weight);
  for (std::size_t v = 0; v < astray.vertices.size(); ++v)
    EXPECT_LT((astray.vertices[v].T_world_vertex.translation() -
               world.graph.vertices[v].T_world_vertex.translation())
                  .norm(),
              1e-6);
}

TEST(RobustPoseGraph, NoLoops) {
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  const PoseGraph before = world.graph;
  const RobustPoseGraphSummary summary = SolveRobust(world.graph, {});
  EXPECT_TRUE(summary.graph.usable);
  EXPECT_EQ(summary.loops_kept + summary.loops_refused + summary.rounds, 0);
  EXPECT_NEAR(AteRmse(world.graph, world.truth), AteRmse(before, world.truth), 1e-6);
}

TEST(RobustPoseGraph, OnlyFalseLoopsLeaveTheOdometry) {
  PoseGraphWorldOptions options = Small();
  options.false_loops = 10;
  PoseGraphWorld world = MakePoseGraphWorld(options);
  const double before = AteRmse(world.graph, world.truth);
  const RobustPoseGraphSummary summary = SolveRobust(world.graph, {});
  EXPECT_TRUE(summary.graph.usable);
  EXPECT_EQ(summary.loops_kept, 0);
  EXPECT_NEAR(AteRmse(world.graph, world.truth), before, 1e-6);
}

// Two sessions, each with its own odometry, that only loops join.
TEST(RobustPoseGraph, SessionsJoinedByLoops) {
  PoseGraphWorldOptions options;
  options.keyframes = 240;
  options.laps = 2;
  options.loops = 25;
  PoseGraphWorld world = MakePoseGraphWorld(options);
  world.graph.edges.erase(world.graph.edges.begin() + 119);
  world.is_false.erase(world.is_false.begin() + 119);
  for (std::size_t i = 120; i < 240; ++i) {
    Pose& T = world.graph.vertices[i].T_world_vertex;
    T = Pose::Trans(30, -20, 1) * Pose::RotZ(2) * T;
  }
  AddLoop(world, 10, 200, 6);
  const RobustPoseGraphSummary summary = SolveRobust(world.graph, {});
  EXPECT_EQ(summary.graph.components, 1);
  const Counts counts = Count(world, summary);
  EXPECT_EQ(counts.false_kept, 0);
  EXPECT_GE(counts.true_kept, 23);
  EXPECT_LE(AteRmse(world.graph, world.truth), 0.5);
}

TEST(RobustPoseGraph, NothingButLoops) {
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  for (auto& edge : world.graph.edges) edge.loop = true;
  const RobustPoseGraphSummary summary = SolveRobust(world.graph, {});
  EXPECT_TRUE(summary.graph.usable);
  EXPECT_EQ(summary.loops_kept, 239);
}

TEST(RobustPoseGraph, SameBytesEveryTime) {
  PoseGraphWorldOptions options = Small();
  options.loops = 20;
  options.false_loops = 10;
  PoseGraphWorld a = MakePoseGraphWorld(options), b = a;
  EXPECT_EQ(SolveRobust(a.graph, {}).edge_weight, SolveRobust(b.graph, {}).edge_weight);
  for (std::size_t i = 0; i < a.truth.size(); ++i)
    EXPECT_EQ(std::memcmp(a.graph.vertices[i].T_world_vertex.data(),
                          b.graph.vertices[i].T_world_vertex.data(), 7 * sizeof(double)),
              0);
}

TEST(RobustPoseGraph, BadGraphsAreLeftAlone) {
  PoseGraph empty;
  EXPECT_FALSE(SolveRobust(empty, {}).graph.usable);
  PoseGraphWorld world = MakePoseGraphWorld(Small());
  AddLoop(world, 20, 180, 0);
  for (const int kind : {0, 1, 2}) {
    PoseGraph bad = world.graph;
    if (kind == 0)
      bad.edges.back().T_from_to.translation().x() = std::numeric_limits<double>::quiet_NaN();
    if (kind == 1) bad.edges.back().information.setZero();
    if (kind == 2) bad.edges.back().to = 5000;
    const RobustPoseGraphSummary summary = SolveRobust(bad, {});
    EXPECT_FALSE(summary.graph.usable);
    EXPECT_NE(summary.graph.message.find("edge 20 -> "), std::string::npos)
        << summary.graph.message;
    EXPECT_EQ(summary.edge_weight, std::vector<double>(bad.edges.size(), 1.)) << "none refused";
  }
}

}  // namespace
}  // namespace sslcd
