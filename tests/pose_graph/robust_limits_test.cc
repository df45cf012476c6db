// SPDX-License-Identifier: BSD-3-Clause
// Up to which error SolveRobust keeps a loop.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/math.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

// A straight drive of 100 steps of 1 m along x, and twelve loops over all of it that agree with
// each other, but are too long by `sigmas` of what odometry and one loop can be off along x.
PoseGraph DriveWithLoops(double sigmas) {
  constexpr int kSteps = 100, kLoops = 12;
  constexpr double kSigma = 0.05;  // of a step and of a loop [m]
  const Vec6 sigma = Vec6::Constant(kSigma);
  const double too_long = sigmas * kSigma * std::sqrt(kSteps + 1.);
  PoseGraph graph;
  for (int i = 0; i <= kSteps; ++i) graph.vertices.push_back({i, Pose::Trans(i, 0, 0)});
  for (int i = 0; i < kSteps + kLoops; ++i) {
    const bool loop = i >= kSteps;
    PoseGraph::Edge edge;
    edge.from = loop ? 0 : i;
    edge.to = loop ? kSteps : i + 1;
    edge.T_from_to = Pose::Trans(loop ? kSteps + too_long : 1, 0, 0);
    edge.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
    edge.loop = loop;
    graph.edges.push_back(edge);
  }
  return graph;
}

// Enough loops outvote odometry with a noise that allows the error.
TEST(RobustPoseGraph, LoopsAreRuledOutFromDriftFactorTimesTheirLimitInSigmas) {
  for (const double drift_factor : {1.5, 3.}) {
    RobustPoseGraphOptions options;
    options.drift_factor = drift_factor;
    const double limit = std::sqrt(Chi2Quantile(options.inlier_probability, 6));
    PoseGraph near = DriveWithLoops(0.97 * drift_factor * limit),
              far = DriveWithLoops(1.03 * drift_factor * limit);
    EXPECT_EQ(SolveRobust(near, options).loops_kept, 12) << drift_factor;
    EXPECT_EQ(SolveRobust(far, options).loops_refused, 12) << drift_factor;
  }
}

// A trusted edge and loops between two vertices, all along x. Five loops agree; one disagrees just
// within the limit, and odometry rules out another on their other side. Once that is back, the
// solution moves away from the former.
TEST(RobustPoseGraph, InTheEndLoopsAreKeptWhereTheyAreWithinTheLimit) {
  RobustPoseGraphOptions options;
  options.drift_factor = 1;
  PoseGraph graph;
  graph.vertices = {{0, Pose(), true}, {1, Pose()}};
  graph.edges = {{0, 1, Pose()}};
  graph.edges[0].information /= 100;
  for (const double x : {38.1, 38.1, 38.1, 38.1, 38.1, 33.28, 41.27}) {
    graph.edges.push_back({0, 1, Pose::Trans(x, 0, 0)});
    graph.edges.back().loop = true;
  }
  const RobustPoseGraphSummary summary = SolveRobust(graph, options);
  for (std::size_t e = 1; e < graph.edges.size(); ++e) {
    const double chi2 =
        EdgeError(graph.edges[e], Pose(), graph.vertices[1].T_world_vertex).squaredNorm();
    EXPECT_EQ(summary.edge_weight[e], chi2 <= summary.chi2_limit ? 1 : 0) << e << ": " << chi2;
  }
  EXPECT_EQ(summary.edge_weight, (std::vector<double>{1, 1, 1, 1, 1, 1, 0, 1}));
}

// As many true loops as these would bring their degrees of freedom along as misfit.
TEST(RobustPoseGraph, ALoneLoopIsKeptUpToItsLimit) {
  RobustPoseGraphOptions options;
  for (const double probability : {0.9, 0.99, 0.9999}) {  // a higher one: a farther limit
    options.inlier_probability = probability;
    const double limit = std::sqrt(Chi2Quantile(probability, 6));
    for (const auto& [sigmas, kept] : {std::pair<double, int>{0.9999 * std::sqrt(6.), 1},
                                       {0.999 * limit, 1},
                                       {1.001 * limit, 0}}) {
      PoseGraph graph = DriveWithLoops(sigmas);
      graph.edges.resize(graph.edges.size() - 11);
      const RobustPoseGraphSummary summary = SolveRobust(graph, options);
      EXPECT_EQ(summary.loops_kept, kept) << sigmas;
      EXPECT_EQ(summary.rounds == 0, sigmas * sigmas <= 6) << "nothing to decide";
    }
  }
}

// The loop's chi2 against fixed odometry is k times the limit, independent of its weight. It keeps
// a weight below 1 while (mu + 1) / mu > k (Yang et al., Eq. 14), and the first mu takes residuals
// of up to twice the worst as convex: (mu + 1) / mu = 2 k.
TEST(RobustPoseGraph, GraduationBeginsConvexAndEndsWhereTheLoopIsDecided) {
  for (const double k : {2., 4., 7.}) {
    for (const double mu_factor : {1.1, 1.4}) {
      RobustPoseGraphOptions options;
      options.mu_factor = mu_factor;
      const double chi2 = k * Chi2Quantile(options.inlier_probability, 6);
      PoseGraph graph;
      graph.vertices = {{0, Pose()}, {1, Pose::Trans(1, 0, 0)}};
      graph.edges = {{0, 1, Pose::Trans(1, 0, 0)}, {0, 1, Pose::Trans(1 + std::sqrt(chi2), 0, 0)}};
      graph.edges[0].information *= 1e8;
      graph.edges[1].loop = true;
      const RobustPoseGraphSummary summary = SolveRobust(graph, options);
      EXPECT_EQ(summary.loops_refused, 1);
      int updates = 1;
      for (double mu = 1 / (2 * k - 1); (mu + 1) / mu > k; mu *= mu_factor) ++updates;
      EXPECT_EQ(summary.rounds, 2 * updates) << "from all loops and from none; k " << k;
    }
  }
}

}  // namespace
}  // namespace sslcd
