// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_factors.h"

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
  double horizontal_off = 0, heading_off = 0;  // a single world has only 14 cycles
  for (int seed = 1; seed <= kWorlds; ++seed) {
    const OdometryFactors factors = LearnOdometryFactors(
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

TEST(LearnOdometryFactors, TakesLoopsEitherWayRound) {
  PoseGraphWorld world = Misjudged(1, 2, 0.5);
  const OdometryFactors factors = LearnOdometryFactors(world.graph, Vec3::UnitZ());
  for (PoseGraph::Edge& edge : world.graph.edges) {
    if (!edge.loop) continue;
    // Exp(e) on the other side
    const Eigen::Matrix<double, 6, 6> to_old = edge.T_from_to.inverse().Adj();
    const Eigen::Matrix<double, 6, 6> information = edge.information;
    edge.information = to_old.transpose() * information * to_old;
    std::swap(edge.from, edge.to);
    edge.T_from_to = edge.T_from_to.inverse();
  }
  const OdometryFactors turned = LearnOdometryFactors(world.graph, Vec3::UnitZ());
  EXPECT_NEAR(turned.horizontal, factors.horizontal, 0.01 * factors.horizontal);
  EXPECT_NEAR(turned.heading, factors.heading, 0.01 * factors.heading);
}

TEST(LearnOdometryFactors, OneWhereNothingTellsOtherwise) {
  PoseGraphWorldOptions options;
  options.loops = 0;
  for (const PoseGraph& graph : {MakePoseGraphWorld(options).graph, PoseGraph()}) {
    const OdometryFactors factors = LearnOdometryFactors(graph, Vec3::UnitZ());
    EXPECT_EQ(factors.horizontal, 1);
    EXPECT_EQ(factors.heading, 1);
  }
}

TEST(LearnOdometryFactors, ErrorsOfHeightAreNotTakenForErrorsOfTheWay) {
  PoseGraphWorld world = Misjudged(1, 1, 1);
  const OdometryFactors level = LearnOdometryFactors(world.graph, Vec3::UnitZ());
  for (PoseGraph::Edge& edge : world.graph.edges)
    if (!edge.loop)
      edge.T_from_to.translation().z() *= 5;  // all of it is error: the course is level
  const OdometryFactors steep = LearnOdometryFactors(world.graph, Vec3::UnitZ());
  EXPECT_NEAR(std::log(steep.horizontal / level.horizontal), 0, 0.3);
  EXPECT_NEAR(std::log(steep.heading / level.heading), 0, 0.3);
}

TEST(LearnOdometryFactors, FailuresAreNoNoise) {
  PoseGraphWorld world = Misjudged(1, 2, 1);
  const OdometryFactors usual = LearnOdometryFactors(world.graph, Vec3::UnitZ());
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
  const OdometryFactors told = LearnOdometryFactors(world.graph, Vec3::UnitZ(), failures),
                        taken_for_noise = LearnOdometryFactors(world.graph, Vec3::UnitZ());
  EXPECT_NEAR(std::log(told.horizontal / usual.horizontal), 0, 0.15);
  EXPECT_NEAR(std::log(told.heading / usual.heading), 0, 0.15);
  EXPECT_LT(taken_for_noise.horizontal, 0.9 * told.horizontal);
}

}  // namespace
}  // namespace sslcd
