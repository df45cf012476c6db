// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/random_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sslcd {
namespace {

// A walk of 400 points, 5 m apart, measured between points 200 apart.
struct MadeUp {
  std::vector<double> lengths = std::vector<double>(399, 5.);
  std::vector<double> truth{0};
  std::vector<WalkDifference> measured;

  MadeUp(double rate, double sigma, unsigned seed, int every = 4) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (const double length : lengths)
      truth.push_back(truth.back() + rate * std::sqrt(length) * normal(random));
    for (int k = 0; k + 200 < 400; k += every)
      measured.push_back({k, k + 200, truth[k + 200] - truth[k] + sigma * normal(random), sigma});
  }
};

TEST(RandomWalk, IsZeroWithoutMeasurements) {
  const RandomWalk walk({1, 2, 3}, {});
  EXPECT_EQ(walk.mean(), Eigen::VectorXd::Zero(4));
  EXPECT_EQ(walk.VarianceAlong(Eigen::VectorXd::Ones(4)), 0);
}

// x_1 ~ N(0, w^2 s), measured with sigma: a product of two normal distributions.
TEST(RandomWalk, OfOneStepIsAWeightedMean) {
  const RandomWalk walk({4}, {{0, 1, 10, 0.5}});
  const double prior = walk.rate() * walk.rate() * 4;
  const double error = (10 - walk.mean()[1]) / 0.5;
  const double noise = 0.25 * (4 + error * error) / 5;  // Student-t of four degrees of freedom
  EXPECT_NEAR(walk.mean()[1], 10 * prior / (prior + noise), 0.05);
  EXPECT_NEAR(walk.VarianceAlong(Eigen::Vector2d(7, 1)), 1 / (1 / prior + 1 / noise), 0.02);
}

TEST(RandomWalk, LearnsItsRate) {
  for (const double rate : {0.01, 0.05, 0.2}) {
    double mean = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const MadeUp made(rate, 0.1, seed);
      mean += std::log(RandomWalk(made.lengths, made.measured).rate() / rate) / 10;
    }
    EXPECT_NEAR(mean, 0, 0.35) << rate;
  }
}

TEST(RandomWalk, DoesNotMoveWhereTheMeasurementsAreNoise) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const MadeUp made(0, 0.3, seed);
    EXPECT_LT(RandomWalk(made.lengths, made.measured).mean().cwiseAbs().maxCoeff(), 0.15) << seed;
  }
}

// Mean square of the error over its variance, for sums with random weights.
TEST(RandomWalk, ErrsAsItsVarianceSays) {
  double ratio = 0;
  constexpr int kSeeds = 40;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const MadeUp made(0.05, 0.1, seed, 20);
    const RandomWalk walk(made.lengths, made.measured);
    Eigen::VectorXd direction(400);
    std::mt19937 random(seed + 100);
    for (int k = 0; k < 400; ++k) direction[k] = std::uniform_real_distribution<>(-1, 1)(random);
    const Eigen::VectorXd error =
        walk.mean() - Eigen::Map<const Eigen::VectorXd>(made.truth.data(), 400);
    ratio += std::pow(direction.dot(error), 2) / walk.VarianceAlong(direction) / kSeeds;
  }
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2);
}

TEST(RandomWalk, FollowsMostMeasurementsNotAWrongOne) {
  MadeUp made(0.02, 0.1, 1);
  const RandomWalk without(made.lengths, made.measured);
  made.measured[20].value += 5;
  const RandomWalk with(made.lengths, made.measured);
  EXPECT_LT((with.mean() - without.mean()).cwiseAbs().maxCoeff(), 0.3);
}

TEST(RandomWalk, StartsAgainAnywhereAfterAnInfiniteLength) {
  MadeUp made(0.05, 0.1, 1);
  const RandomWalk known(made.lengths, made.measured);
  made.lengths[199] = std::numeric_limits<double>::infinity();
  for (WalkDifference& each : made.measured) each.value += 70;  // all span the step
  const RandomWalk walk(made.lengths, made.measured);
  EXPECT_NEAR(std::log(walk.rate() / known.rate()), 0, 0.5);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(400);
  step[200] = 1;
  step[199] = -1;
  const double variance = walk.VarianceAlong(step);
  EXPECT_LT(variance, 4) << "the walk that the measurements span with it";
  EXPECT_NEAR(walk.mean()[200] - walk.mean()[199], made.truth[200] - made.truth[199] + 70,
              3 * std::sqrt(variance));
}

}  // namespace
}  // namespace sslcd
