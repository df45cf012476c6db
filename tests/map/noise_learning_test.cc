// SPDX-License-Identifier: BSD-3-Clause
#include "map/noise_learning.h"

#include <gtest/gtest.h>

#include <random>

namespace sslcd {
namespace {

// A car 20 m ahead of a camera that stands still, and a detection that is off by `error`: to the
// right, down, ahead. [m]
struct Sight {
  Sight() { landmark.pose = {Vec3(0, 0, 20), 1.5}; }
  void See(const Vec3& error, double yaw_error = 0) {
    Detection detection;
    detection.T_cam_object =
        ToPose({landmark.pose.position + error, landmark.pose.yaw + yaw_error}, gravity);
    LearnNoise(landmark, detection, Pose(), gravity, noise, scale);
  }

  GravityFrame gravity;
  DetectionNoise noise;
  NoiseScale scale = NoiseScale::Uniform(2);
  MapLandmark landmark;
};

TEST(LearnNoise, EachComponentFollowsItsOwnErrors) {
  Sight sight;
  sight.See(Vec3(0, 0, 0.3));  // along the ray
  EXPECT_GT(sight.scale.radial, 2);
  EXPECT_LT(sight.scale.lateral, 2);
  EXPECT_LT(sight.scale.vertical, 2);
  EXPECT_LT(sight.scale.yaw, 2);
  sight = {};
  sight.See(Vec3(0.3, 0, 0));
  EXPECT_LT(sight.scale.radial, 2);
  EXPECT_GT(sight.scale.lateral, 2);
  sight = {};
  sight.See(Vec3(0, 0.3, 0));
  EXPECT_GT(sight.scale.vertical, 2);
  sight = {};
  sight.See(Vec3::Zero(), 1);
  EXPECT_GT(sight.scale.yaw, 2);
}

TEST(LearnNoise, HeadingsCountModuloHalfATurnAndNotForRoundThings) {
  Sight sight;
  sight.See(Vec3::Zero(), M_PI);
  EXPECT_LT(sight.scale.yaw, 2) << "front and back may be mistaken for each other";
  sight = {};
  sight.landmark.symmetry = Symmetry::kFull;
  sight.See(Vec3::Zero(), 1);
  EXPECT_EQ(sight.scale.yaw, 2);
}

TEST(LearnNoise, SettlesAtTheScaleOfTheErrors) {
  Sight sight;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const double sigma = SigmasAt(20, sight.noise, NoiseScale::Uniform(5)).radial;
  double mean = 0;
  for (int i = 0; i < 4000; ++i) {
    sight.See(Vec3(0, 0, sigma * normal(random)));
    if (i >= 2000) mean += sight.scale.radial / 2000;
  }
  EXPECT_NEAR(mean, 5, 0.4);
}

TEST(LearnNoise, StaysWithinItsBounds) {
  Sight sight;
  for (int i = 0; i < 300; ++i) sight.See(Vec3(0, 0, 1000));
  EXPECT_EQ(sight.scale.radial, 40);
  EXPECT_EQ(sight.scale.lateral, 0.5) << "no errors at all";
}

}  // namespace
}  // namespace sslcd
