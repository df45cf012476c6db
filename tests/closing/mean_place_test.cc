// SPDX-License-Identifier: BSD-3-Clause
#include "closing/mean_place.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// A camera that drives past one object, a metre a frame, and sees it in each.
class Drive : public ::testing::Test {
 protected:
  static constexpr int kFrames = 10;

  Drive() {
    for (int i = 0; i < kFrames; ++i) {
      FrameRecord record;
      record.frame = i;
      record.T_odom_cam = record.T_world_cam = Pose::Trans(0, 0, i);
      Detection detection;
      detection.T_cam_object =
          record.T_world_cam.inverse() * Pose(state_.gravity().Upright(kYaw), kPlace + errors_[i]);
      record.detections = {detection};
      state_.frames.Append(record);
      pass_.sightings.emplace_back(i, 0);
    }
  }

  void SetError(int frame, const Vec3& error, double turn_rad = 0) {
    FrameStore frames;
    for (FrameRecord record : state_.frames) {
      if (record.frame == frame)
        record.detections[0].T_cam_object =
            record.T_world_cam.inverse() *
            Pose(state_.gravity().Upright(kYaw + turn_rad), kPlace + error);
      frames.Append(record);
    }
    state_.frames = frames;
  }

  std::optional<MeanSighting> Mean(const PathRange& range = {0, 100, 1}) const {
    return MeanPlace(pass_, state_, {}, range);
  }

  static constexpr double kYaw = 0.3;
  const Vec3 kPlace{0.5, 1, 12};
  std::vector<Vec3> errors_ = std::vector<Vec3>(kFrames, Vec3::Zero());
  MapState state_{ObjectMap(GravityFrame(), LabelTable(), {}, {}, {}), {}};
  PassObject pass_;
};

TEST_F(Drive, WhereTheSightingsAgree) {
  const auto mean = Mean();
  ASSERT_TRUE(mean);
  EXPECT_LT((mean->pose.position - kPlace).norm(), 1e-9);
  EXPECT_NEAR(mean->pose.yaw, kYaw, 1e-9);
  EXPECT_NEAR(mean->height_m, -1, 1e-9) << "y points down: a metre below the camera";
  EXPECT_NEAR(mean->seen_m, 4.5, 1e-9);
}

TEST_F(Drive, OnARangeOfThePathAlone) {
  SetError(9, Vec3(5, 0, 0));
  const auto mean = Mean({2, 8, 1});
  ASSERT_TRUE(mean);
  EXPECT_LT((mean->pose.position - kPlace).norm(), 1e-9);
  EXPECT_NEAR(mean->seen_m, 5, 1e-9) << "both ends of the range belong to it";
}

TEST_F(Drive, NoneWithFewerSightingsThanAskedFor) {
  EXPECT_TRUE(Mean({2, 4, 3}));
  EXPECT_FALSE(Mean({2, 4, 4}));
  EXPECT_FALSE(Mean({50, 60, 0})) << "not one";
}

TEST_F(Drive, NearSightingsCountMore) {
  SetError(0, Vec3(1, 0, 0));  // across the ray, from 12 m
  const double far = (Mean()->pose.position - kPlace).norm();
  SetError(0, Vec3::Zero());
  SetError(9, Vec3(1, 0, 0));  // from 3 m
  const double near = (Mean()->pose.position - kPlace).norm();
  EXPECT_GT(far, 0.01);
  EXPECT_GT(near, 1.2 * far);
}

TEST_F(Drive, AFrontTakenForTheBackIsOutvoted) {
  for (const int frame : {1, 4, 6}) SetError(frame, Vec3::Zero(), M_PI);
  EXPECT_NEAR(Mean()->pose.yaw, kYaw, 1e-9);
}

TEST_F(Drive, ItsHeightIsAgainstTheNearestCamera) {
  FrameStore rising;
  for (FrameRecord record : state_.frames) {
    record.T_world_cam.translation().y() = -0.1 * record.frame;
    record.detections[0].T_cam_object =
        record.T_world_cam.inverse() * Pose(state_.gravity().Upright(kYaw), kPlace);
    rising.Append(record);
  }
  state_.frames = rising;
  EXPECT_NEAR(Mean()->height_m, -1.9, 1e-9) << "the last one";
  EXPECT_NEAR(Mean({0, 5, 1})->height_m, -1.5, 1e-9);
}

}  // namespace
}  // namespace sslcd
