// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/gnc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace sslcd {
namespace {

TEST(GncWeight, MinimisesTheSurrogateOfTheTruncatedCost) {
  for (const double limit : {1., 9.}) {
    for (const double mu : {0.1, 1., 10.}) {
      for (const double chi2 : {0., 0.05, 0.3, 0.6, 0.95, 1.05, 1.6, 3., 20.}) {
        const auto surrogate = [&](double w) {
          return w * chi2 * limit + mu * (1 - w) / (mu + w) * limit;
        };
        const double weight = GncWeight(chi2 * limit, mu, limit);
        EXPECT_GE(weight, 0);
        EXPECT_LE(weight, 1);
        for (double other = 0; other <= 1; other += 0.01)
          EXPECT_LE(surrogate(weight), surrogate(other) + 1e-12) << mu << " " << chi2;
      }
    }
  }
}

TEST(GncWeight, IsHardInTheEnd) {
  EXPECT_EQ(GncWeight(8.99, 1e6, 9), 1);
  EXPECT_EQ(GncWeight(9.01, 1e6, 9), 0);
}

// Two fixed vertices that agree with a trusted edge and loops up to these chi2.
PoseGraph Pinned(double trusted_chi2, std::initializer_list<double> loop_chi2) {
  PoseGraph graph;
  graph.vertices = {{0, Pose(), true}, {1, Pose::Trans(1, 0, 0), true}};
  graph.edges = {{0, 1, Pose::Trans(1 + std::sqrt(trusted_chi2), 0, 0)}};
  for (const double chi2 : loop_chi2) {
    graph.edges.push_back({0, 1, Pose::Trans(1 + std::sqrt(chi2), 0, 0)});
    graph.edges.back().loop = true;
  }
  return graph;
}

Gnc Started(const PoseGraph& graph, double limit, PoseFreedom freedom = PoseFreedom::kFull) {
  RobustPoseGraphOptions options;
  options.graph.freedom = freedom;
  Gnc gnc(graph, options, limit);
  gnc.Start(1);
  return gnc;
}

TEST(Gnc, ALoopBeyondTheLimitCostsTheLimit) {
  EXPECT_NEAR(Started(Pinned(30, {4, 50}), 9).Cost(), 30 + 4 + 9, 1e-9);
  EXPECT_NEAR(Started(Pinned(0, {}), 9).Cost(), 0, 1e-9);
}

TEST(Gnc, LoopsAgreeWhileTheirMisfitIsThatOfTrueOnes) {
  EXPECT_TRUE(Started(Pinned(1.9, {5, 5}), 9).AllAgree()) << "two loops of 6 DoF: up to 12";
  EXPECT_FALSE(Started(Pinned(2.1, {5, 5}), 9).AllAgree());
  EXPECT_TRUE(Started(Pinned(1.9, {3, 3}), 9, PoseFreedom::kUpright).AllAgree()) << "of 4 DoF";
  EXPECT_FALSE(Started(Pinned(2.1, {3, 3}), 9, PoseFreedom::kUpright).AllAgree());
}

TEST(Gnc, OneLoopBeyondTheLimitIsNoAgreement) {
  for (const double limit : {0.5, 9.}) {
    EXPECT_TRUE(Started(Pinned(0, {0.99 * limit, 0, 0}), limit).AllAgree());
    EXPECT_FALSE(Started(Pinned(0, {1.01 * limit, 0, 0}), limit).AllAgree());
  }
}

// The pose between a trusted edge and a loop that are as sure: half way with the loop on.
TEST(Gnc, StartsWithLoopsOnOrOff) {
  PoseGraph graph = Pinned(0, {1});
  graph.vertices[1].fixed = false;
  Gnc gnc(graph, {}, 9);
  for (const double weight : {0., 1.}) {
    gnc.Start(weight);
    EXPECT_NEAR(gnc.graph().vertices[1].T_world_vertex.translation().x(), 1 + weight / 2, 1e-6);
  }
  EXPECT_EQ(gnc.rounds(), 0);
}

TEST(Gnc, GraduationEndsWithEachLoopOnOrOff) {
  Gnc gnc = Started(Pinned(0, {4, 8.9, 9.1, 50}), 9);
  gnc.Graduate();
  EXPECT_GT(gnc.rounds(), 1);
  EXPECT_LT(gnc.rounds(), 100);
}

TEST(Gnc, AFactorNextToOneDoesNotGraduateForEver) {
  RobustPoseGraphOptions options;
  options.mu_factor = 1 + 1e-9;
  Gnc gnc(Pinned(0, {50}), options, 9);
  gnc.Start(1);
  gnc.Graduate();
  EXPECT_EQ(gnc.rounds(), 100);
}

}  // namespace
}  // namespace sslcd
