// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_by_loops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "pose_graph/pose_graph_world.h"

namespace sslcd {
namespace {

// The odometry's errors are `horizontal` and `heading` times larger than its information claims.
PoseGraphWorld Misjudged(unsigned seed, double horizontal, double heading) {
  PoseGraphWorldOptions options;
  options.seed = seed;
  options.loops = 200;
  PoseGraphWorld world = MakePoseGraphWorld(options);
  for (PoseGraph::Edge& edge : world.graph.edges) {
    if (edge.loop) continue;
    edge.information.topLeftCorner<3, 3>() *= horizontal * horizontal;
    edge.information.bottomRightCorner<3, 3>() *= heading * heading;
  }
  return world;
}

class LearnsFactors : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(LearnsFactors, OfAnOdometryThatIsBetterOrWorseThanItSays) {
  const auto [horizontal, heading] = GetParam();
  constexpr int kWorlds = 10;
  double horizontal_off = 0, heading_off = 0;  // a single world has only 15 loops
  for (int seed = 1; seed <= kWorlds; ++seed) {
    const OdometryByLoops factors = LearnOdometryByLoops(
        Misjudged(static_cast<unsigned>(seed), horizontal, heading).graph, Vec3::UnitZ());
    EXPECT_NEAR(std::log(factors.horizontal / horizontal), 0, 1.4) << "seed " << seed;
    EXPECT_NEAR(std::log(factors.heading / heading), 0, 1.4) << "seed " << seed;
    horizontal_off += std::log(factors.horizontal / horizontal) / kWorlds;
    heading_off += std::log(factors.heading / heading) / kWorlds;
  }
  EXPECT_NEAR(horizontal_off, 0, 0.5 * std::abs(std::log(horizontal)) + 0.15)
      << "the prior pulls towards one";
  EXPECT_NEAR(heading_off, 0, 0.5 * std::abs(std::log(heading)) + 0.15);
}

INSTANTIATE_TEST_SUITE_P(Factors, LearnsFactors,
                         ::testing::Values(std::pair(1., 1.), std::pair(3., 1.), std::pair(1., 3.),
                                           std::pair(.3, 1.), std::pair(1., .3),
                                           std::pair(.3, 4.)));

TEST(LearnOdometryByLoops, TakesLoopsEitherWayRound) {
  PoseGraphWorld world = Misjudged(1, 2, 0.5);
  const OdometryByLoops factors = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
  for (PoseGraph::Edge& edge : world.graph.edges) {
    if (!edge.loop) continue;
    // Exp(e) on the other side
    const Eigen::Matrix<double, 6, 6> to_old = edge.T_from_to.inverse().Adj();
    const Eigen::Matrix<double, 6, 6> information = edge.information;
    edge.information = to_old.transpose() * information * to_old;
    std::swap(edge.from, edge.to);
    edge.T_from_to = edge.T_from_to.inverse();
  }
  const OdometryByLoops turned = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
  EXPECT_NEAR(turned.horizontal, factors.horizontal, 0.01 * factors.horizontal);
  EXPECT_NEAR(turned.heading, factors.heading, 0.01 * factors.heading);
}

TEST(LearnOdometryByLoops, OneWhereNothingTellsOtherwise) {
  PoseGraphWorldOptions options;
  options.loops = 0;
  for (const PoseGraph& graph : {MakePoseGraphWorld(options).graph, PoseGraph()}) {
    const OdometryByLoops factors = LearnOdometryByLoops(graph, Vec3::UnitZ());
    EXPECT_EQ(factors.horizontal, 1);
    EXPECT_EQ(factors.heading, 1);
  }
}

TEST(LearnOdometryByLoops, ErrorsOfHeightAreNotTakenForErrorsOfTheWay) {
  PoseGraphWorld world = Misjudged(1, 1, 1);
  const OdometryByLoops level = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
  for (PoseGraph::Edge& edge : world.graph.edges)
    if (!edge.loop)
      edge.T_from_to.translation().z() *= 5;  // all of it is error: the course is level
  const OdometryByLoops steep = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
  EXPECT_NEAR(std::log(steep.horizontal / level.horizontal), 0, 0.3);
  EXPECT_NEAR(std::log(steep.heading / level.heading), 0, 0.3);
}

TEST(LearnOdometryByLoops, FailuresAreNoNoise) {
  PoseGraphWorld world = Misjudged(1, 2, 1);
  const OdometryByLoops usual = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
  std::vector<OdometryFailures> failures;
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  for (PoseGraph::Edge& edge : world.graph.edges) {
    if (edge.loop) continue;
    const bool lost = failures.size() % 300 == 250;
    failures.push_back(lost ? OdometryFailures{1e6, 10, 1} : OdometryFailures());
    for (const int part : {0, 3}) {
      auto block = edge.information.block<3, 3>(part, part);
      const double variance =
          part == 0 ? failures.back().translation_m2 : failures.back().rotation_rad2;
      block = Eigen::Matrix3d(Eigen::Matrix3d(block).inverse() + variance * one).inverse().eval();
    }
  }
  const OdometryByLoops told = LearnOdometryByLoops(world.graph, Vec3::UnitZ(), 0, failures),
                        taken_for_noise = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
  EXPECT_NEAR(std::log(told.horizontal / usual.horizontal), 0, 0.15);
  EXPECT_NEAR(std::log(told.heading / usual.heading), 0, 0.15);
  EXPECT_LT(taken_for_noise.horizontal, 0.9 * told.horizontal);
}

// Turns every step of the odometry by `turn` for each metre.
void Turn(double turn, PoseGraph& graph) {
  for (PoseGraph::Edge& edge : graph.edges)
    if (!edge.loop)
      edge.T_from_to.so3() =
          edge.T_from_to.so3() *
          lie::SO3<double>::Exp(Vec3(turn * edge.T_from_to.translation().norm() * Vec3::UnitZ()));
}

TEST(LearnOdometryByLoops, LearnsTheTurnOfTheHeading) {
  constexpr double kTurn = 2e-3;  // .003 rad a metre of random walk leave 1e-4 over 900 m
  for (const double turn : {-kTurn, kTurn}) {
    PoseGraphWorld world = Misjudged(3, 1, 1);
    const double before = LearnOdometryByLoops(world.graph, Vec3::UnitZ()).turn;
    EXPECT_LT(std::abs(before), 0.15 * kTurn);
    Turn(turn, world.graph);
    const OdometryByLoops learnt = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
    EXPECT_NEAR(learnt.turn, before - turn, 0.15 * kTurn);
    EXPECT_NEAR(std::log(learnt.heading), 0, 0.5) << "what is systematic is no noise";
  }
}

TEST(LearnOdometryByLoops, TheTurnIncludesWhatIsCorrectedAlready) {
  constexpr double kTurn = 2e-3;
  PoseGraphWorld world = Misjudged(3, 1, 1);
  Turn(kTurn, world.graph);
  const OdometryByLoops first = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
  Turn(first.turn, world.graph);
  const OdometryByLoops again = LearnOdometryByLoops(world.graph, Vec3::UnitZ(), first.turn);
  EXPECT_NEAR(again.turn, first.turn, 0.02 * kTurn);
}

TEST(LearnOdometryByLoops, LoopsOverALostStepTellOfTheRest) {
  PoseGraphWorld world = Misjudged(2, 2, 3);
  const OdometryByLoops whole = LearnOdometryByLoops(world.graph, Vec3::UnitZ());
  std::vector<OdometryFailures> failures;
  for (PoseGraph::Edge& edge : world.graph.edges) {
    if (edge.loop) continue;
    failures.push_back(edge.to == 450 ? OdometryFailures{1e6, 10, 1} : OdometryFailures());
    if (edge.to != 450) continue;
    edge.T_from_to = Pose::Trans(Vec3(300, -100, 0)) * edge.T_from_to;
    edge.information.diagonal() << Vec3::Constant(1e-6), Vec3::Constant(0.1);
  }
  const OdometryByLoops cut = LearnOdometryByLoops(world.graph, Vec3::UnitZ(), 0, failures);
  EXPECT_NEAR(std::log(cut.horizontal / whole.horizontal), 0, 0.3);
  EXPECT_NEAR(std::log(cut.heading / whole.heading), 0, 0.3);
}

}  // namespace
}  // namespace sslcd
