// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/gauss_newton.h"

#include <gtest/gtest.h>

#include "pose_graph/cost.h"
#include "pose_graph/index.h"
#include "pose_graph_world.h"

namespace sslcd {
namespace {

struct Problem {
  PoseGraph graph;
  std::vector<std::pair<int, int>> ends;
  std::vector<double> weights;
  std::vector<bool> anchored;
  std::vector<Pose> poses;
  PoseGraphOptions options;
  int steps = 0;

  explicit Problem(const PoseGraph& made)
      : graph(made),
        ends(IndexPoseGraph(made).ends),
        weights(made.edges.size(), 1.),
        anchored(made.vertices.size()),
        poses(PosesOf(made)) {
    anchored[0] = true;
    options.tolerance = 1e-12;
  }
  GaussNewtonEnd Solve() {
    const GaussNewtonSummary summary =
        GaussNewton({graph, ends, weights, anchored}, options, poses);
    steps = summary.steps;
    return summary.end;
  }
  double Chi2() const { return Chi2Of(graph, ends, weights, poses); }
};

Problem Drifted(unsigned seed = 1) {
  PoseGraphWorldOptions options;
  options.seed = seed;
  options.keyframes = 120;
  options.loops = 20;
  return Problem(MakePoseGraphWorld(options).graph);
}

TEST(GaussNewton, EndsWhereChi2HasNoSlope) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    Problem problem = Drifted(seed);
    const double before = problem.Chi2();
    ASSERT_EQ(problem.Solve(), GaussNewtonEnd::kConverged);
    const double at = problem.Chi2();
    EXPECT_LT(at, 0.5 * before);
    constexpr double kStep = 1e-3;  // a few percent of the measurements' sigmas
    for (std::size_t v = 1; v < problem.poses.size(); v += 7) {
      for (int axis = 0; axis < 6; ++axis) {
        const auto chi2_at = [&](double step) {
          Problem moved = problem;
          moved.poses[v] = moved.poses[v] * Pose::Exp(step * Vec6::Unit(axis));
          return moved.Chi2();
        };
        const double forward = chi2_at(kStep), back = chi2_at(-kStep);
        EXPECT_GT(forward, at);
        EXPECT_GT(back, at);
        EXPECT_LT(std::abs(forward - back), 0.1 * (forward + back - 2 * at));
      }
    }
  }
}

TEST(GaussNewton, AnchorsStayAndEdgesOfWeightZeroDoNotCount) {
  Problem problem = Drifted(), without = Drifted();
  problem.graph.edges.back().T_from_to = Pose::Trans(50, 0, 0);
  problem.weights.back() = 0;
  without.ends.pop_back();
  const Pose anchor = problem.poses[0];
  ASSERT_EQ(problem.Solve(), GaussNewtonEnd::kConverged);
  ASSERT_EQ(without.Solve(), GaussNewtonEnd::kConverged);
  EXPECT_EQ((anchor.inverse() * problem.poses[0]).Log().norm(), 0);
  for (std::size_t v = 0; v < problem.poses.size(); ++v)
    EXPECT_LT((without.poses[v].inverse() * problem.poses[v]).Log().norm(), 1e-6);
}

TEST(GaussNewton, AGraphWithoutContradictionsTakesNoStep) {
  Problem problem = Drifted();
  for (std::size_t e = 0; e < problem.ends.size(); ++e) {
    const auto [from, to] = problem.ends[e];
    problem.graph.edges[e].T_from_to = problem.poses[from].inverse() * problem.poses[to];
  }
  EXPECT_EQ(problem.Solve(), GaussNewtonEnd::kConverged);
  EXPECT_LE(problem.steps, 1);  // rounding
  EXPECT_LT(problem.Chi2(), 1e-12);
}

TEST(GaussNewton, StopsAtItsLimitOfSteps) {
  Problem problem = Drifted();
  problem.options.max_iterations = 1;
  EXPECT_EQ(problem.Solve(), GaussNewtonEnd::kTooManySteps);
  EXPECT_EQ(problem.steps, 1);
}

TEST(GaussNewton, IsStuckWhereAPoseIsNotMeasured) {
  Problem problem = Drifted();
  problem.weights.assign(problem.weights.size(), 0.);
  problem.weights[0] = 1;
  problem.poses[1] = problem.poses[1] * Pose::Trans(1, 0, 0);
  const double before = problem.Chi2();
  EXPECT_EQ(problem.Solve(), GaussNewtonEnd::kStuck);
  EXPECT_EQ(problem.steps, 0);
  EXPECT_EQ(problem.Chi2(), before);
}

TEST(GaussNewton, IsStuckWhereNumbersOverflow) {
  for (const double far_m : {1e160, 1e308}) {
    Problem problem = Drifted();
    problem.poses[1] = Pose::Trans(far_m, 0, 0);
    EXPECT_EQ(problem.Solve(), GaussNewtonEnd::kStuck);
  }
}

TEST(GaussNewton, NeverRaisesChi2) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Problem problem = Drifted();
    PoseNoise noise(seed);
    for (std::size_t v = 1; v < problem.poses.size(); ++v) {
      Vec6 push;
      for (int i = 0; i < 6; ++i) push[i] = noise.Normal() * (i < 3 ? 5 : 1);
      problem.poses[v] = problem.poses[v] * Pose::Exp(push);
    }
    const double before = problem.Chi2();
    problem.Solve();
    EXPECT_LE(problem.Chi2(), before);
  }
}

}  // namespace
}  // namespace sslcd
