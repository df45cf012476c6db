// SPDX-License-Identifier: BSD-3-Clause
// How certain a measured loop is.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "common_trees.h"

namespace sslcd {
namespace {

TEST(LoopMeter, WhatEveryLoopIsOffByIsPartOfItsCovariance) {
  const TwoPasses world;
  const CommonTrees common(world);
  LoopOptions options;
  options.sigma_m = 0;
  options.sigma_rad = 0;
  const LoopMeter exact(common.objects(), world.state, world.passes, options);
  LoopOptions with = options;
  with.sigma_m = 0.5;
  with.sigma_rad = 0.1;
  const auto without = exact.MeasureBetween(TwoPasses::kSecond + 30, 30);
  const auto loop = LoopMeter(common.objects(), world.state, world.passes, with)
                        .MeasureBetween(TwoPasses::kSecond + 30, 30);
  ASSERT_TRUE(without && loop);
  const Eigen::Matrix<double, 6, 6> added = loop->row.covariance - without->row.covariance;
  Vec6 expected;
  expected << Vec3::Constant(0.25), Vec3::Constant(0.01);
  EXPECT_LT((added - Eigen::Matrix<double, 6, 6>(expected.asDiagonal())).norm(), 1e-9);
}

TEST(LoopMeter, ACameraFarFromTheObjectsIsKnownNoBetterThanOdometry) {
  const TwoPasses world;
  const CommonTrees common(world);
  const LoopOptions options;
  LoopMeter meter(common.objects(), world.state, world.passes, options);
  const auto amidst = meter.Measure(world.end_m() - 30, 0);
  const auto last = meter.Measure(world.end_m(), 50);
  ASSERT_TRUE(amidst && last);
  EXPECT_GT(last->query, amidst->query + 15);
  EXPECT_GT(last->row.covariance.topLeftCorner(3, 3).trace(),
            amidst->row.covariance.topLeftCorner(3, 3).trace());
}

// sigma^2 = sigma_m^2 + (of the odometry between object and camera)^2, once for each camera; the
// object was seen from 10 m, and half of the way counts for the turn.
TEST(LoopMeter, ObjectsCountByTheOdometryBetweenThemAndTheTwoCameras) {
  const TwoPasses world;
  const CommonTrees common(world);
  LoopOptions options = ExactOptions();
  options.odometry.translation_floor_m = 0.1;
  options.odometry.rotation_floor_rad = 0.02;
  const FrameStore& frames = world.state.frames;
  const int query = TwoPasses::kSecond + 40, match = 25;
  const auto variance = [&](int frame, double seen_m) {
    const int metres = std::abs(frames.AtPath(seen_m) - frame);
    return std::pow(0.1, 2) + std::pow(0.02 * (10 + 0.5 * metres), 2);
  };
  std::vector<std::pair<double, Vec3>> weighted;
  Vec3 centre = Vec3::Zero();
  double weights = 0;
  for (const auto& [i, old] : common.pairs) {
    const double old_m = world.passes.NearestPass(frames, old, match);
    const double weight = 1 / (std::pow(common.sigma_m, 2) +
                               variance(query, common.local.seen_m[i]) + variance(match, old_m));
    weighted.push_back({weight, world.state.map.at(old).pose.position});
    centre += weight * weighted.back().second;
    weights += weight;
  }
  centre /= weights;
  double certainty = 0;  // of the heading, by the weighted layout
  for (const auto& [weight, place] : weighted)
    certainty +=
        weight * (std::pow(place.x() - centre.x(), 2) + std::pow(place.z() - centre.z(), 2));
  const auto loop =
      LoopMeter(common.objects(), world.state, world.passes, options).MeasureBetween(query, match);
  ASSERT_TRUE(loop);
  EXPECT_NEAR(loop->heading_sigma, 1 / std::sqrt(certainty), 1e-6 * loop->heading_sigma);
}

// Where the camera is in sight of the objects, and 20 m after the last of them.
TEST(LoopMeter, OutOfSightOfTheObjectsOdometryLeadsToTheCamera) {
  const TwoPasses world;
  const CommonTrees common = CommonTrees(world).Between(world.end_m() - 60, world.end_m() - 30);
  const auto variance = [&](int back, double vertical_walk) {
    LoopOptions options = ExactOptions();
    options.odometry.vertical_walk = vertical_walk;  // does not tell on the objects
    const LoopMeter meter(common.objects(), world.state, world.passes, options);
    const int query = TwoPasses::kSecond + 60 - back;
    return meter.MeasureBetween(query, 60 - back).value().row.covariance(1, 1);
  };
  const double last_m = common.seen().second;
  EXPECT_NEAR(variance(40, 0.5), variance(40, 0), 1e-9);
  const int away = world.state.frames.size() - 1 - world.state.frames.AtPath(last_m);
  ASSERT_GT(away, 25);
  EXPECT_NEAR(variance(0, 0.5) - variance(0, 0), 0.25 * away, 1e-6);
}

TEST(LoopMeter, TwiceTheScatterOfTheObjectsIsFourTimesTheCovariance) {
  const TwoPasses world;
  CommonTrees common(world);
  LoopOptions options = ExactOptions();
  options.drift.tilt_sigma_rad = 1e-9;
  const auto covariance = [&](double sigma_m) {
    common.sigma_m = sigma_m;
    return LoopMeter(common.objects(), world.state, world.passes, options)
        .MeasureBetween(TwoPasses::kSecond + 50, 30)
        ->row.covariance;
  };
  const auto once = covariance(0.1), twice = covariance(0.2);
  EXPECT_LT((twice - 4 * once).norm(), 1e-9);
  EXPECT_GT(once(0, 0), 1e-4);
}

// Scattered objects put the camera where they may: by chi2 with three degrees of freedom.
TEST(LoopMeter, TheErrorIsWhatTheCovarianceSays) {
  const TwoPasses world;
  const CommonTrees exact(world);
  const LoopOptions options = ExactOptions();
  std::mt19937 random(3);
  const auto normal = [&] {  // of unit variance, nearly
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() % 1000001) * 1e-6 - 0.5;
    return sum;
  };
  constexpr int kTrials = 200;
  const int query = TwoPasses::kSecond + 58, match = 30;
  double chi2 = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    CommonTrees common = exact;
    for (UprightPose& place : common.local.places)
      place.position += common.sigma_m * Vec3(normal(), normal(), normal());
    const auto loop = LoopMeter(common.objects(), world.state, world.passes, options)
                          .MeasureBetween(query, match)
                          .value();
    const Vec6 error = (loop.row.T_match_query.inverse() * world.TrueLoop(match, query)).Log();
    const int horizontal[] = {0, 2, 4};  // sideways, forward, heading
    Eigen::Matrix3d covariance;
    Vec3 off;
    for (int i = 0; i < 3; ++i) {
      off[i] = error[horizontal[i]];
      for (int j = 0; j < 3; ++j)
        covariance(i, j) = loop.row.covariance(horizontal[i], horizontal[j]);
    }
    chi2 += off.dot(covariance.ldlt().solve(off)) / kTrials;
  }
  EXPECT_GT(chi2, 2);
  EXPECT_LT(chi2, 3.6);
}

TEST(LoopMeter, OneHeadingIsKnownToAFifthOfARadian) {
  const TwoPasses world(Pose(), false, {Vec3(-4, 1, 30)}, Symmetry::kNone);
  const CommonTrees common(world);
  const LoopOptions options = ExactOptions();
  const auto loop = LoopMeter(common.objects(), world.state, world.passes, options)
                        .MeasureBetween(TwoPasses::kSecond + 30, 30);
  ASSERT_TRUE(loop);
  EXPECT_NEAR(loop->heading_sigma, 0.2, 1e-9);
}

}  // namespace
}  // namespace sslcd
