// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sslcd/core/error.h"

namespace sslcd::sim {
namespace {

constexpr OdometryNoise kNoOdometryNoise{0, 0, 0, 0};

DetectorNoise Perfect() {
  DetectorNoise noise;
  noise.scale = noise.flip_rate = noise.box_sigma_px = noise.miss_rate_near = noise.miss_rate_far =
      0;
  noise.false_positives = 0;
  return noise;
}

/// Standing camera, one car straight ahead.
World OneCar(int frames, double range) {
  World world;
  world.camera = {700, 700, 600, 200, Vec3(0, 0, 0), 1200, 400};
  world.objects.push_back(
      {0, "Car", Vec3(4, 1.7, 1.5), {Pose(GravityFrame().Upright(0.3), Vec3(0, 1, range))}});
  world.truth.poses.resize(frames);
  for (int i = 0; i < frames; ++i) world.truth.stamps.push_back(0.1 * i);
  return world;
}

World ShortStreet(std::uint64_t seed) {
  StreetOptions options;
  options.frames = 60;
  return MakeStreet(seed, options);
}

TEST(SimulateOdometry, WithoutNoiseIsTheTruth) {
  const World world = MakeStreet(1);
  const Trajectory odometry = SimulateOdometry(world.truth, kNoOdometryNoise, 1);
  ASSERT_EQ(odometry.size(), world.truth.size());
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    EXPECT_LT((odometry.poses[i].inverse() * world.truth.poses[i]).Log().norm(), 1e-9);
    EXPECT_EQ(odometry.stamps[i], world.truth.stamps[i]);
  }
}

TEST(SimulateOdometry, ScaleErrorMakesItLonger) {
  const World world = MakeStreet(1);
  const Trajectory odometry = SimulateOdometry(world.truth, {0.03, 0, 0, 0}, 1);
  EXPECT_LT(
      (odometry.poses.back().translation() - 1.03 * world.truth.poses.back().translation()).norm(),
      1e-6);
}

TEST(SimulateOdometry, NoiseIsARandomWalkOfTheGivenSize) {
  const World world = ShortStreet(1);
  const double distance = 0.8 * 59;
  const OdometryNoise noise{0, 1e-3, 0, 0};
  double squares = 0;
  constexpr int kRuns = 200;
  for (int seed = 0; seed < kRuns; ++seed) {
    const Pose end = SimulateOdometry(world.truth, noise, seed).poses.back();
    squares += std::pow((world.truth.poses.back().inverse() * end).so3().Log().y(), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / kRuns), 1e-3 * std::sqrt(distance),
              0.15 * 1e-3 * std::sqrt(distance));
}

TEST(SimulateOdometry, StandingStillHasNoNoise) {
  const World world = OneCar(20, 10);
  for (const Pose& pose : SimulateOdometry(world.truth, {}, 1).poses)
    EXPECT_LT(pose.Log().norm(), 1e-12);
}

TEST(SimulateOdometry, Degenerate) {
  EXPECT_EQ(SimulateOdometry({}, {}, 1).size(), 0u);
  EXPECT_EQ(SimulateOdometry({{0}, {Pose::Trans(1, 2, 3)}}, {}, 1).poses[0].translation().norm(),
            0);
  EXPECT_THROW(SimulateOdometry({}, {std::nan(""), 0, 0, 0}, 1), Error);
}

TEST(SimulateDetections, WithoutNoiseIsTheTruth) {
  const World world = ShortStreet(2);
  const SimulatedDetections result = SimulateDetections(world, Perfect(), 1);
  ASSERT_EQ(result.frames.size(), world.truth.size());
  int count = 0;
  for (std::size_t frame = 0; frame < result.frames.size(); ++frame) {
    for (const Detection& detection : result.frames[frame]) {
      ++count;
      const WorldObject& object = world.objects[result.identity[detection.row]];
      const Pose T_world_object = world.truth.poses[frame] * detection.T_cam_object;
      const Pose& truth = object.PoseAt(static_cast<int>(frame));
      EXPECT_LT((T_world_object.translation() - truth.translation()).norm(), 1e-9);
      if (object.label == "Car") {
        EXPECT_LT((T_world_object.inverse() * truth).Log().norm(), 1e-6);
      }
      EXPECT_LT((detection.dims - object.dims).norm(), 1e-9);
      EXPECT_EQ(detection.label, object.label);
    }
  }
  EXPECT_GT(count, 300);
}

TEST(SimulateDetections, RowsBoxesAndScoresAreValid) {
  const World world = MakeParkingLot(2);
  const SimulatedDetections result = SimulateDetections(world, {}, 1);
  int row = 0;
  bool false_positive = false;
  for (const std::vector<Detection>& detections : result.frames) {
    for (const Detection& detection : detections) {
      EXPECT_EQ(detection.row, row++);
      ASSERT_TRUE(detection.box);
      EXPECT_GT(detection.box->Area(), 0);
      EXPECT_GE(detection.box->left, 0);
      EXPECT_GE(detection.box->top, 0);
      EXPECT_LE(detection.box->right, world.camera.width);
      EXPECT_LE(detection.box->bottom, world.camera.height);
      EXPECT_TRUE(detection.score > 0 && detection.score <= 1);
      EXPECT_TRUE((detection.dims.array() > 0).all());
      EXPECT_GT(detection.T_cam_object.translation().z(), 0);
      false_positive |= result.identity[detection.row] < 0;
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(row), result.identity.size());
  EXPECT_TRUE(false_positive);
}

TEST(SimulateDetections, SameSeedSameDetections) {
  const World world = ShortStreet(2);
  const SimulatedDetections a = SimulateDetections(world, {}, 9),
                            b = SimulateDetections(world, {}, 9),
                            c = SimulateDetections(world, {}, 10);
  ASSERT_EQ(a.identity, b.identity);
  for (std::size_t frame = 0; frame < a.frames.size(); ++frame) {
    for (std::size_t i = 0; i < a.frames[frame].size(); ++i) {
      EXPECT_EQ(a.frames[frame][i].T_cam_object.translation(),
                b.frames[frame][i].T_cam_object.translation());
    }
  }
  EXPECT_NE(a.identity, c.identity);
}

/// Errors of the position along the ray and of the yaw, over many frames.
struct Errors {
  double mean = 0, sigma = 0, flips = 0, count = 0;
};
Errors RangeErrors(const World& world, const DetectorNoise& noise, std::uint64_t seed) {
  const SimulatedDetections result = SimulateDetections(world, noise, seed);
  const double true_range = world.objects[0].PoseAt(0).translation().norm();
  Errors errors;
  double squares = 0;
  for (const std::vector<Detection>& detections : result.frames) {
    for (const Detection& detection : detections) {
      // Along the true ray; lateral errors have no share in this component.
      const Vec3 ray = world.objects[0].PoseAt(0).translation().normalized();
      const double error = detection.T_cam_object.translation().dot(ray) - true_range;
      errors.mean += error;
      squares += error * error;
      errors.count += 1;
      errors.flips +=
          std::abs(WrapAngle(GravityFrame().YawOf(detection.T_cam_object.so3()) - 0.3)) > M_PI / 2;
    }
  }
  errors.mean /= errors.count;
  errors.sigma = std::sqrt(squares / errors.count - errors.mean * errors.mean);
  errors.flips /= errors.count;
  return errors;
}

TEST(SimulateDetections, NoiseGrowsWithRangeAsTold) {
  DetectorNoise noise = Perfect();
  noise.scale = 2;
  noise.constant_fraction = 0;
  noise.flip_rate = 0.1;
  for (double range : {10., 40.}) {
    const World world = OneCar(4000, range);
    const double sigma = SigmasAt(world.objects[0].PoseAt(0).translation().norm(), noise.sigmas,
                                  NoiseScale::Uniform(2))
                             .radial;
    const Errors errors = RangeErrors(world, noise, 3);
    EXPECT_EQ(errors.count, 4000);
    EXPECT_NEAR(errors.sigma, sigma, 0.05 * sigma);
    EXPECT_NEAR(errors.mean, 0, 0.07 * sigma);
    EXPECT_NEAR(errors.flips, 0.1, 0.02);
  }
}

TEST(SimulateDetections, AShareOfTheVarianceIsConstantPerObject) {
  DetectorNoise noise = Perfect();
  noise.scale = 1;
  noise.constant_fraction = 0.5;
  const World world = OneCar(40, 20);
  const double sigma =
      SigmasAt(world.objects[0].PoseAt(0).translation().norm(), noise.sigmas, NoiseScale()).radial;
  double within = 0, between = 0;
  constexpr int kRuns = 300;
  for (int seed = 0; seed < kRuns; ++seed) {
    const Errors errors = RangeErrors(world, noise, seed);
    within += errors.sigma * errors.sigma / kRuns;
    between += errors.mean * errors.mean / kRuns;
  }
  EXPECT_NEAR(within, 0.5 * sigma * sigma, 0.05 * sigma * sigma);
  EXPECT_NEAR(between, 0.5 * sigma * sigma, 0.12 * sigma * sigma);

  noise.constant_fraction = 1;
  EXPECT_NEAR(RangeErrors(world, noise, 1).sigma, 0, 1e-6);
}

TEST(SimulateDetections, MissesGrowWithRange) {
  DetectorNoise noise = Perfect();
  noise.miss_rate_near = 0.1;
  noise.miss_rate_far = 0.7;
  noise.max_range_m = 60;
  for (double range : {12., 48.}) {
    const World world = OneCar(4000, range);
    const double expected = 0.1 + 0.6 * world.objects[0].PoseAt(0).translation().norm() / 60;
    const double detected =
        static_cast<double>(SimulateDetections(world, noise, 5).identity.size()) / 4000;
    EXPECT_NEAR(1 - detected, expected, 0.03);
  }
  EXPECT_TRUE(SimulateDetections(OneCar(10, 61), noise, 5).identity.empty());
}

TEST(SimulateDetections, HiddenAndCutOffObjectsAreNotSeen) {
  World world = OneCar(1, 20);
  EXPECT_EQ(SimulateDetections(world, Perfect(), 1).identity.size(), 1u);
  WorldObject behind = world.objects[0];
  behind.id = 1;
  behind.T_world_object[0].translation().z() = 40;
  world.objects.push_back(behind);
  EXPECT_EQ(SimulateDetections(world, Perfect(), 1).identity, std::vector<int>{0});
  world.objects[1].T_world_object[0].translation().x() = 15;
  EXPECT_EQ(SimulateDetections(world, Perfect(), 1).identity.size(), 2u);
  // mostly beyond the right border
  world.objects[1].T_world_object[0].translation().x() = 40 * 600. / 700 + 1.5;
  EXPECT_EQ(SimulateDetections(world, Perfect(), 1).identity.size(), 1u);
  world.objects[1].T_world_object[0].translation() = Vec3(0, 1, -20);
  EXPECT_EQ(SimulateDetections(world, Perfect(), 1).identity.size(), 1u);
}

TEST(SimulateDetections, FalsePositivesHaveTheirRate) {
  DetectorNoise noise = Perfect();
  noise.false_positives = 0.5;
  World world = OneCar(4000, 20);
  world.objects.clear();
  const SimulatedDetections result = SimulateDetections(world, noise, 1);
  EXPECT_TRUE(
      std::all_of(result.identity.begin(), result.identity.end(), [](int id) { return id == -1; }));
  EXPECT_NEAR(static_cast<double>(result.identity.size()) / 4000, 0.5, 0.05);
}

TEST(SimulateDetections, EmptyWorld) {
  const SimulatedDetections result = SimulateDetections(World{}, {}, 1);
  EXPECT_TRUE(result.frames.empty());
  EXPECT_TRUE(result.identity.empty());
}

TEST(SimulateDetections, BadOptions) {
  DetectorNoise noise;
  noise.flip_rate = 1.5;
  EXPECT_THROW(SimulateDetections(World{}, noise, 1), Error);
}

TEST(MakeFrames, PutsBothTogether) {
  const World world = ShortStreet(1);
  const Trajectory odometry = SimulateOdometry(world.truth, {}, 1);
  const SimulatedDetections detections = SimulateDetections(world, {}, 1);
  const std::vector<Frame> frames = MakeFrames(odometry, detections);
  ASSERT_EQ(frames.size(), 60u);
  EXPECT_EQ(frames[7].index, 7);
  EXPECT_EQ(frames[7].stamp, world.truth.stamps[7]);
  EXPECT_EQ(frames[7].detections.size(), detections.frames[7].size());
}

}  // namespace
}  // namespace sslcd::sim
