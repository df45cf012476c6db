// SPDX-License-Identifier: BSD-3-Clause
#include "closing/resightings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sslcd {
namespace {

const Vec3 kUp(0, -1, 0);

// A camera that sees objects in every frame, wherever they are; y is down.
struct InSight {
  MapState state{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), {}};
  PassMap passes{{}, 30.};

  // `places`: of the objects, in the world. The world is `scale` times the odometry.
  InSight(const std::vector<Pose>& path, const std::vector<Vec3>& places, double scale = 1) {
    for (const Pose& T_world_cam : path) {
      FrameRecord record;
      record.frame = state.frames.size();
      record.T_odom_cam = record.T_world_cam = T_world_cam;
      record.T_odom_cam.translation() /= scale;
      for (std::size_t i = 0; i < places.size(); ++i) {
        Detection detection;
        detection.T_cam_object = T_world_cam.inverse() * Pose::Trans(places[i]);
        record.detections.push_back(detection);
        record.matched.push_back({static_cast<int>(i)});
      }
      const std::vector<Detection> seen = record.detections;
      state.frames.Append(record);
      passes.AddFrame(state, seen);
    }
  }
};

std::vector<Pose> Straight(int metres) {
  std::vector<Pose> path;
  for (int i = 0; i <= metres; ++i) path.push_back(Pose::Trans(0, 0, i));
  return path;
}

// A bend, a metre a frame.
std::vector<Pose> Bend(int metres, double rad_per_m) {
  std::vector<Pose> path{Pose()};
  while (static_cast<int>(path.size()) <= metres)
    path.push_back(path.back() * Pose::RotY(rad_per_m) * Pose::Trans(0, 0, 1));
  return path;
}

TEST(ResightingsOf, AreAtLeast3AndAtMost40MetresOfPathApart) {
  const InSight world(Straight(100), {Vec3(4, 0, 110)});
  const auto all = ResightingsOf(world.state, world.passes, {}, 1, 1);
  EXPECT_EQ(all.size(), 13u) << "3, 6, ..., 39 m after the first sighting";
  for (std::size_t i = 1; i < all.size(); ++i)
    EXPECT_GT(all[i].odometry()(0, 0), all[i - 1].odometry()(0, 0));
  EXPECT_TRUE(ResightingsOf(InSight(Straight(2), {Vec3(4, 0, 10)}).state,
                            InSight(Straight(2), {Vec3(4, 0, 10)}).passes, {}, 1, 1)
                  .empty());
}

TEST(ResightingsOf, MovedIsWhatOdometryAndDetectorGetWrong) {
  const Vec3 place(4, -1, 30);
  InSight world(Straight(6), {place});
  for (const Resighting& each : ResightingsOf(world.state, world.passes, {}, 1, 1))
    EXPECT_LT(each.moved.norm(), 1e-9);
  // Odometry that is 1 m too far to the right and 2 m too high, in one step.
  std::vector<Pose> path = Straight(6);
  MapState off{world.state.map, {}};
  for (const FrameRecord& frame : world.state.frames) {
    FrameRecord record = frame;
    if (record.frame > 0) record.T_odom_cam = Pose::Trans(1, -2, 0) * record.T_odom_cam;
    off.frames.Append(record);
  }
  const GravityFrame& gravity = off.gravity();
  const auto all = ResightingsOf(off, world.passes, {}, 1, 1);
  ASSERT_FALSE(all.empty());
  for (const Resighting& each : all)
    EXPECT_LT((gravity.Basis() * each.moved - Vec3(1, -2, 0)).norm(), 1e-9);
}

TEST(ResightingsOf, OdometryIsMadeMetric) {
  const InSight world(Bend(30, 0.03), {Vec3(4, 0, 40)}, 0.7);
  const auto all = ResightingsOf(world.state, world.passes, {}, 0.7, 1);
  ASSERT_FALSE(all.empty());
  for (const Resighting& each : all) EXPECT_LT(each.moved.norm(), 1e-9);
  const auto wrong = ResightingsOf(world.state, world.passes, {}, 1, 1);
  EXPECT_GT(wrong.back().moved.norm(), 1);
}

TEST(ResightingsOf, TheDetectionsCovarianceIsThatOfBoth) {
  const InSight world(Straight(4), {Vec3(0, 0, 24)});
  const auto all = ResightingsOf(world.state, world.passes, {}, 1, 1);
  ASSERT_EQ(all.size(), 1u);
  const DetectionSigmas first = SigmasAt(24, {}, {}), second = SigmasAt(21, {}, {});
  const Eigen::Matrix3d in_world =
      world.state.gravity().Basis() * all[0].detection * world.state.gravity().Basis().transpose();
  EXPECT_NEAR(in_world(2, 2), std::pow(first.radial, 2) + std::pow(second.radial, 2), 1e-9);
  EXPECT_NEAR(in_world(0, 0), std::pow(first.lateral, 2) + std::pow(second.lateral, 2), 1e-9);
  EXPECT_NEAR(in_world(1, 1), std::pow(first.vertical, 2) + std::pow(second.vertical, 2), 1e-9);
}

// A noisy copy of the steps from `first` to `last`: where it puts an object that the last camera
// sees, in the world.
Vec3 ByNoisySteps(const std::vector<Pose>& path, const Vec3& place, const OdometryNoise& noise,
                  double tilt_factor, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Pose T_world_cam = path.front();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Pose step = path[i - 1].inverse() * path[i];
    const OdometrySigmas sigmas = SigmasOf(step, noise);
    Eigen::Matrix<double, 6, 1> error;  // y is vertical
    for (double& entry : error) entry = normal(random);
    error[0] *= sigmas.horizontal;
    error[1] *= sigmas.vertical;
    error[2] *= sigmas.horizontal;
    error.tail<3>() *= sigmas.rotation;
    error[3] *= tilt_factor;
    error[5] *= tilt_factor;
    T_world_cam = T_world_cam * step * Pose::Exp(error);
  }
  return T_world_cam * (path.back().inverse() * place);
}

TEST(ResightingsOf, OdometrysCovarianceIsThatOfManyNoisyRuns) {
  constexpr int kRuns = 4000;
  OdometryNoise noise;
  noise.translation_walk = 0.002;
  noise.vertical_walk = 0.004;
  noise.rotation_walk = 1e-3;
  noise.rotation_turn = 5e-3;
  noise.translation_floor_m = noise.rotation_floor_rad = 1e-9;
  constexpr double kTilt = 0.4;
  for (const double rad_per_m : {0., 0.05}) {
    const std::vector<Pose> path = Bend(39, rad_per_m);
    const Vec3 place = path.back() * Vec3(8, 0, 15);
    const InSight world(path, {place});
    const auto all = ResightingsOf(world.state, world.passes, noise, 1, kTilt);
    ASSERT_FALSE(all.empty());
    std::mt19937 random(1);
    Eigen::Matrix3d found = Eigen::Matrix3d::Zero();
    for (int run = 0; run < kRuns; ++run) {
      const Vec3 moved = world.state.gravity().Basis().transpose() *
                         (ByNoisySteps(path, place, noise, kTilt, random) - place);
      found += moved * moved.transpose() / kRuns;
    }
    const Eigen::Matrix3d expected = all.back().odometry();
    EXPECT_LT((found - expected).norm(), 0.08 * expected.norm()) << found << "\n\n" << expected;
    EXPECT_NEAR(found(2, 2), expected(2, 2), 0.08 * expected(2, 2));
  }
}

// Odometry that turns by random roll and pitch, `factor` times the noise.
FrameStore Tilting(double factor, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, factor * OdometryNoise().rotation_walk);
  FrameStore frames;
  Pose T_odom_cam;
  for (int i = 0; i <= 300; ++i) {
    FrameRecord record;
    record.frame = i;
    record.T_odom_cam = T_odom_cam;
    frames.Append(record);
    T_odom_cam =
        T_odom_cam * Pose::Trans(0, 0, 1) * Pose::RotX(normal(random)) * Pose::RotZ(normal(random));
  }
  return frames;
}

TEST(LargestTiltFactor, OfATiltThatIsAllErrorIsItsFactor) {
  constexpr int kRuns = 60;
  OdometryNoise noise;
  noise.rotation_turn = 0;
  for (const double factor : {0.3, 1., 3.}) {
    double square = 0;
    for (unsigned seed = 1; seed <= kRuns; ++seed)
      square += std::pow(LargestTiltFactor(Tilting(factor, seed), kUp, noise), 2) / kRuns;
    EXPECT_NEAR(std::sqrt(square) / factor, 1, 0.15) << factor;
  }
}

TEST(LargestTiltFactor, ZeroInAPlaneAndOneWithoutAnyStep) {
  FrameStore frames;
  for (const Pose& pose : Bend(50, 0.1)) {
    FrameRecord record;
    record.T_odom_cam = Pose::RotX(0.1) * pose;
    frames.Append(record);
    if (frames.size() == 1) {
      EXPECT_EQ(LargestTiltFactor(frames, kUp, {}), 1);
    }
  }
  const Vec3 up = Pose::RotX(0.1) * kUp;  // of the plane
  EXPECT_NEAR(LargestTiltFactor(frames, up, {}), 0, 1e-9);
}

// The detector's noise, the same for the same seed.
void AddNoise(MapState& state, double sigma_m) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, sigma_m);
  MapState noisy{state.map, {}};
  for (FrameRecord record : state.frames) {
    for (Detection& detection : record.detections)
      detection.T_cam_object =
          Pose::Trans(normal(random), normal(random), normal(random)) * detection.T_cam_object;
    noisy.frames.Append(record);
  }
  state.frames = noisy.frames;
}

std::vector<Vec3> Places() {
  std::vector<Vec3> places;
  for (int i = 0; i < 30; ++i) places.push_back({i % 2 == 0 ? -6. : 7., 0, 10. + 2 * i});
  return places;
}

TEST(LearnOdometryInSight, IsTwiceAsCarefulAsTheResightings) {
  const InSight empty(Straight(100), {});
  OdometryFactors factors = LearnOdometryInSight(empty.state, empty.passes, {}, 1);
  EXPECT_EQ(factors.horizontal, 2);
  EXPECT_EQ(factors.heading, 2);
  EXPECT_EQ(factors.vertical, 2);
  EXPECT_NEAR(factors.tilt, 0.01 * 2, 1e-12) << "in a plane, times the factor on heights";

  InSight world(Straight(100), Places());
  AddNoise(world.state, 0.2);
  const OdometryFactors learnt = FactorsFromResightings(
      ResightingsOf(world.state, world.passes, {}, 1, 0.01), {0.5, 0.5, 0.5});
  ASSERT_GT(learnt.horizontal, 0.05);
  factors = LearnOdometryInSight(world.state, world.passes, {}, 1);
  EXPECT_NEAR(factors.horizontal, 2 * learnt.horizontal, 1e-12);
  EXPECT_NEAR(factors.heading, 2 * learnt.heading, 1e-12);
  EXPECT_NEAR(factors.vertical, 2 * learnt.vertical, 1e-12);
}

TEST(LearnOdometryInSight, HasALeastFactor) {
  const InSight world(Straight(100), Places());  // neither odometry nor detector has any error
  OdometryNoise loose;
  loose.translation_walk = loose.vertical_walk = 1e3;
  const OdometryFactors learnt =
      FactorsFromResightings(ResightingsOf(world.state, world.passes, loose, 1, 0.01));
  ASSERT_LT(learnt.horizontal, 0.05);
  ASSERT_LT(learnt.vertical, 0.05);
  const OdometryFactors factors = LearnOdometryInSight(world.state, world.passes, loose, 1);
  EXPECT_EQ(factors.horizontal, 0.1);
  EXPECT_EQ(factors.heading, 0.1);
  EXPECT_EQ(factors.vertical, 0.1);
  EXPECT_NEAR(factors.tilt, 0.001, 1e-12);
}

TEST(LearnOdometryInSight, TheTiltIsNoLargerThanConfigured) {
  InSight world({Pose()}, {});
  MapState tilted{world.state.map, Tilting(50, 1)};
  EXPECT_NEAR(LearnOdometryInSight(tilted, world.passes, {}, 1).tilt, 1. * 2, 1e-12);
}

// The same frames, with a report of the step to one of them.
MapState Reporting(const MapState& state, int step, const StepUncertainty& report) {
  MapState again{state.map, FrameStore(100)};
  for (int i = 0; i < state.frames.size(); ++i)
    again.frames.Append(state.frames[i], i == step ? std::optional(report) : std::nullopt);
  return again;
}

TEST(ResightingsOf, WhatOdometryReportsIsNoNoise) {
  const Vec3 place(4, 0, 30);
  const InSight world(Straight(6), {place});
  const MapState reporting = Reporting(world.state, 2, {false, 0.5, 0.1});
  const auto before = ResightingsOf(world.state, world.passes, {}, 1, 1),
             now = ResightingsOf(reporting, world.passes, {}, 1, 1);
  ASSERT_EQ(now.size(), before.size());
  ASSERT_EQ(now.size(), 2u);
  const Vec3 arm = place - Vec3(0, 0, 2);  // from the camera that turned
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(before[i].fixed, Eigen::Matrix2d::Zero());
    // forward is x, left is z
    EXPECT_NEAR(now[i].fixed(0, 0), 0.25 + 0.01 * arm.z() * arm.z(), 1e-9);
    EXPECT_NEAR(now[i].fixed(1, 1), 0.25 + 0.01 * arm.x() * arm.x(), 1e-9);
    const Eigen::Matrix2d horizontal = now[i].odometry().topLeftCorner<2, 2>();
    EXPECT_EQ(horizontal, Eigen::Matrix2d(before[i].odometry().topLeftCorner<2, 2>()));
    EXPECT_NEAR(now[i].odometry()(2, 2) - before[i].odometry()(2, 2),
                0.25 + 0.01 * arm.squaredNorm(), 1e-9);
  }
}

TEST(LargestTiltFactor, ALostStepSaysNothingAboutIt) {
  MapState state{InSight({Pose()}, {}).state.map, Tilting(1, 1)};
  const double factor = LargestTiltFactor(state.frames, kUp, {});
  EXPECT_EQ(LargestTiltFactor(Reporting(state, 100, {true}).frames, kUp, {}), factor);
}

}  // namespace
}  // namespace sslcd
