// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_meter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "two_passes.h"

namespace sslcd {
namespace {

// All trees of the second pass with those of the first one.
struct Common {
  PassLayout local;
  std::vector<std::pair<int, LandmarkId>> pairs;

  explicit Common(const TwoPasses& world)
      : local(world.passes.Recent(world.state, world.end_m() - 70, 2)) {
    for (std::size_t i = 0; i < local.objects.size(); ++i)
      for (const auto& [early, late] : world.trees)
        if (local.objects[i].id == late.value) pairs.push_back({static_cast<int>(i), early});
  }
  CommonObjects objects() const { return {local, pairs, 0.2, 200}; }
};

double Apart(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

class LoopMeterDirections : public ::testing::TestWithParam<bool> {};

TEST_P(LoopMeterDirections, MeasuresTheTrueRelativePoseWhateverTheDrift) {
  const Pose drift = Pose::Trans(6, 0, -4) * Pose::RotY(0.2);
  const TwoPasses world(drift, GetParam());
  const Common common(world);
  ASSERT_GE(common.pairs.size(), 10u);
  const LoopOptions options;
  const auto loop = LoopMeter(world.state, world.passes, options)
                        .Measure(common.objects(), world.end_m() - 30, 0);
  ASSERT_TRUE(loop);
  const LoopClosure& row = loop->row;
  EXPECT_LT(Apart(row.T_match_query, world.TrueLoop(loop->match, loop->query)), 1e-3);
  EXPECT_NEAR(row.viewpoint_change_rad, GetParam() ? M_PI : 0, 1e-3);
  EXPECT_NEAR(world.state.frames[loop->query].travelled, world.end_m() - 30, 1);
  EXPECT_EQ(row.query_frame, world.state.frames[loop->query].frame);
  EXPECT_LT(loop->match, TwoPasses::kFrames);
  EXPECT_EQ(row.pairs.size(), common.pairs.size());
  EXPECT_LT(row.T_match_query.translation().norm(), 1) << "the nearest old camera";
  EXPECT_GT(loop->heading_sigma, 0);
  EXPECT_LT(loop->heading_sigma, options.acceptance.max_heading_sigma_rad);
}

INSTANTIATE_TEST_SUITE_P(SameAndOpposite, LoopMeterDirections, ::testing::Bool());

// The odometry's tilt drifts, but cameras around one place stand upright on average.
TEST(LoopMeter, LevelsBothMapsBeforeItComparesThem) {
  const Pose tilt(lie::SO3<double>::RotX(0.06) * lie::SO3<double>::RotZ(-0.04), Vec3(3, 0, -2));
  const TwoPasses world(tilt);
  const Common common(world);
  const LoopOptions options;
  const auto loop = LoopMeter(world.state, world.passes, options)
                        .Measure(common.objects(), world.end_m() - 30, 0);
  ASSERT_TRUE(loop);
  EXPECT_LT(Apart(loop->row.T_match_query, world.TrueLoop(loop->match, loop->query)), 0.02);
}

TEST(LoopMeter, WhatEveryLoopIsOffByIsPartOfItsCovariance) {
  const TwoPasses world;
  const Common common(world);
  LoopOptions options;
  options.sigma_m = 0;
  options.sigma_rad = 0;
  const LoopMeter exact(world.state, world.passes, options);
  LoopOptions with = options;
  with.sigma_m = 0.5;
  with.sigma_rad = 0.1;
  const auto without = exact.MeasureBetween(TwoPasses::kSecond + 30, 30, common.objects());
  const auto loop = LoopMeter(world.state, world.passes, with)
                        .MeasureBetween(TwoPasses::kSecond + 30, 30, common.objects());
  ASSERT_TRUE(without && loop);
  const Eigen::Matrix<double, 6, 6> added = loop->row.covariance - without->row.covariance;
  Vec6 expected;
  expected << Vec3::Constant(0.25), Vec3::Constant(0.01);
  EXPECT_LT((added - Eigen::Matrix<double, 6, 6>(expected.asDiagonal())).norm(), 1e-9);
}

TEST(LoopMeter, ACameraFarFromTheObjectsIsKnownNoBetterThanOdometry) {
  const TwoPasses world;
  const Common common(world);
  const LoopOptions options;
  const LoopMeter meter(world.state, world.passes, options);
  const auto amidst = meter.Measure(common.objects(), world.end_m() - 30, 0);
  const auto last = meter.Measure(common.objects(), world.end_m(), 50);
  ASSERT_TRUE(amidst && last);
  EXPECT_GT(last->query, amidst->query + 15);
  EXPECT_GT(last->row.covariance.topLeftCorner(3, 3).trace(),
            amidst->row.covariance.topLeftCorner(3, 3).trace());
}

TEST(LoopMeter, NoneWhereObjectsFixNoPose) {
  const TwoPasses world;
  Common common(world);
  const LoopOptions options;
  const LoopMeter meter(world.state, world.passes, options);
  common.pairs.resize(1);
  EXPECT_FALSE(meter.Measure(common.objects(), world.end_m() - 30, 0)) << "one tree has no heading";
  common.pairs.clear();
  EXPECT_FALSE(meter.Measure(common.objects(), world.end_m() - 30, 0));
}

TEST(ViewpointChange, IsTheHorizontalAngleBetweenViewingDirections) {
  const GravityFrame gravity;
  EXPECT_NEAR(ViewpointChange({}, Pose::RotY(2.), gravity), 2, 1e-12);
  EXPECT_NEAR(ViewpointChange(Pose::RotY(3.), Pose::RotY(-3.), gravity), 2 * M_PI - 6, 1e-12);
  EXPECT_NEAR(ViewpointChange({}, Pose::Trans(5, 0, 5), gravity), 0, 1e-12);
}

}  // namespace
}  // namespace sslcd
