// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_meter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common_trees.h"

namespace sslcd {
namespace {

double Apart(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

class LoopMeterDirections : public ::testing::TestWithParam<bool> {};

TEST_P(LoopMeterDirections, MeasuresTheTrueRelativePoseWhateverTheDrift) {
  const Pose drift = Pose::Trans(6, 0, -4) * Pose::RotY(0.2);
  const TwoPasses world(drift, GetParam());
  const CommonTrees common(world);
  ASSERT_GE(common.pairs.size(), 10u);
  const LoopOptions options;
  const auto loop = LoopMeter(common.objects(), world.state, world.passes, options)
                        .Measure(world.end_m() - 30, 0);
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
  const CommonTrees common(world);
  const LoopOptions options;
  const auto loop = LoopMeter(common.objects(), world.state, world.passes, options)
                        .Measure(world.end_m() - 30, 0);
  ASSERT_TRUE(loop);
  EXPECT_LT(Apart(loop->row.T_match_query, world.TrueLoop(loop->match, loop->query)), 0.02);
}

TEST(LoopMeter, NoneWhereObjectsFixNoPose) {
  const TwoPasses world;
  CommonTrees common(world);
  const LoopOptions options;
  for (const std::size_t trees : {1, 0}) {
    common.pairs.resize(trees, {});
    LoopMeter meter(common.objects(), world.state, world.passes, options);
    EXPECT_FALSE(meter.Measure(world.end_m() - 30, 0)) << "one tree has no heading";
  }
}

// Behind the last object the heading is less certain, and the more so the farther away.
TEST(LoopMeter, TriesCamerasTenAndTwentyMetresBackWhileTheHeadingIsUncertain) {
  const TwoPasses world;
  const CommonTrees common(world);
  LoopOptions options;
  const auto measure = [&](double query_m, double max_heading_sigma_rad) {
    options.acceptance.max_heading_sigma_rad = max_heading_sigma_rad;
    LoopMeter meter(common.objects(), world.state, world.passes, options);
    return meter.Measure(query_m, 50).value();
  };
  const auto query_m = [&](const LoopMeasurement& loop) {
    return world.state.frames[loop.query].travelled;
  };
  const double end_m = world.end_m(), start_m = end_m - 40;
  const double at_end = measure(end_m, 10).heading_sigma,
               before = measure(end_m - 10, 10).heading_sigma;
  ASSERT_LT(before, at_end);
  EXPECT_NEAR(query_m(measure(end_m, 10)), end_m, 1e-9);
  EXPECT_NEAR(query_m(measure(end_m, 0.5 * (before + at_end))), end_m - 10, 1e-9);
  EXPECT_NEAR(query_m(measure(end_m, 0)), end_m - 20, 1e-9) << "the best of the three";
  ASSERT_LT(measure(start_m, 10).heading_sigma, measure(start_m - 10, 10).heading_sigma);
  EXPECT_NEAR(query_m(measure(start_m, 0)), start_m, 1e-9) << "farther back it gets worse";
}

TEST(LoopMeter, TheQueryCameraStandsNearTheCommonObjects) {
  const TwoPasses world;
  const CommonTrees all(world), some = all.Between(world.end_m() - 45, world.end_m() - 20);
  ASSERT_GE(some.pairs.size(), 4u);
  const auto [first_m, last_m] = some.seen();
  LoopOptions options;
  options.acceptance.max_heading_sigma_rad = 10;
  LoopMeter meter(some.objects(), world.state, world.passes, options);
  for (const double beyond_m : {0., 6.}) {
    const auto query_m = [&](double asked_m) {
      const auto loop = meter.Measure(asked_m, beyond_m);
      return world.state.frames[loop.value().query].travelled;
    };
    // the first frame from there on: frames are a metre apart
    EXPECT_NEAR(query_m(world.end_m()), last_m + beyond_m + 0.5, 0.51);
    EXPECT_NEAR(query_m(world.end_m() - 60), first_m - beyond_m + 0.5, 0.51);
    EXPECT_NEAR(query_m(world.end_m() - 30), world.end_m() - 30, 1e-9);
  }
}

TEST(LoopMeter, TheMatchIsTheNearestOldCameraThatSawTheObjectsOrStoodBetweenItsViews) {
  const TwoPasses world;
  const CommonTrees common(world);
  LoopOptions options;
  options.acceptance.max_heading_sigma_rad = 10;
  LoopMeter meter(common.objects(), world.state, world.passes, options);
  const auto match = [&](int query) {
    const double query_m = world.state.frames[query].travelled;
    return meter.Measure(query_m, 50).value().match;
  };
  EXPECT_EQ(match(TwoPasses::kSecond), 0) << "the very first frame";
  EXPECT_EQ(match(TwoPasses::kSecond + 23), 23);
  int last = 0;
  for (const PassObject& pass : world.passes.passes())
    if (pass.last_m < 200) last = std::max(last, pass.sightings.back().first);
  ASSERT_LT(last, 58);
  EXPECT_EQ(match(TwoPasses::kSecond + 60), last);
}

// The camera's up as the measurement has it, where roll and pitch come from levelling alone.
class LoopMeterLevelling : public testing::Test {
 protected:
  void Roll(int frame, double angle_rad) {
    const Pose T = world_.state.frames[frame].T_world_cam;
    world_.state.frames.SetPose(frame, T * Pose(lie::SO3<double>::RotZ(angle_rad), Vec3::Zero()));
  }
  // The turn between a level camera's up and the measured one. [rad]
  double Tilt(int query, int match) const {
    const LoopOptions options = ExactOptions();
    const CommonTrees common(world_);
    const LoopMeter meter(common.objects(), world_.state, world_.passes, options);
    const Pose T = meter.MeasureBetween(query, match).value().row.T_match_query;
    return (T.so3() * Vec3(0, -1, 0)).cross(Vec3(0, -1, 0)).norm();
  }
  TwoPasses world_;
};

TEST_F(LoopMeterLevelling, AskedOfTheCamerasWithinTwentyMetresOfPath) {
  const FrameStore& frames = world_.state.frames;
  const int query = TwoPasses::kSecond + 10;
  EXPECT_LT(Tilt(query, 30), 1e-9);
  for (const int change : {-13, -12, -11, -1, 1, 2, 19, 20, 21}) {
    Roll(query + change, 0.1);
    const double metres = std::abs(frames[query + change].travelled - frames[query].travelled);
    if (metres <= 20)
      EXPECT_GT(Tilt(query, 30), 1e-3) << metres;
    else
      EXPECT_LT(Tilt(query, 30), 1e-9) << metres;
    Roll(query + change, -0.1);
  }
}

TEST_F(LoopMeterLevelling, AtBothEndsOfTheRun) {
  const int last = world_.state.frames.size() - 1;
  for (int i = 1; i <= 20; ++i) Roll(i, 0.1);
  EXPECT_GT(Tilt(TwoPasses::kSecond + 30, 0), 0.08);
  for (int i = 1; i <= 20; ++i) Roll(i, -0.1);
  for (int i = 1; i <= 20; ++i) Roll(last - i, 0.1);
  EXPECT_GT(Tilt(last, 30), 0.08);
}

TEST(ViewpointChange, IsTheHorizontalAngleBetweenViewingDirections) {
  const GravityFrame gravity;
  EXPECT_NEAR(ViewpointChange({}, Pose::RotY(2.), gravity), 2, 1e-12);
  EXPECT_NEAR(ViewpointChange(Pose::RotY(3.), Pose::RotY(-3.), gravity), 2 * M_PI - 6, 1e-12);
  EXPECT_NEAR(ViewpointChange({}, Pose::Trans(5, 0, 5), gravity), 0, 1e-12);
}

}  // namespace
}  // namespace sslcd
