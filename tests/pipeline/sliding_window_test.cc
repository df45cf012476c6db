// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/sliding_window.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

MapState EmptyState() { return {ObjectMap(GravityFrame(), LabelTable(), {}, {}, {}), {}}; }

// Adds the frame and, as in the mapper, its keyframe if it is one.
bool AddFrame(MapState& state, SlidingWindow& window, const Pose& T_odom_cam) {
  const bool keyframe = window.IsKeyframe(state.frames, T_odom_cam);
  FrameRecord record;
  record.frame = state.frames.size();
  record.T_odom_cam = record.T_world_cam = T_odom_cam;
  state.frames.Append(record);
  double log_scale = 0;
  if (keyframe) window.AddKeyframe(state, log_scale, 0);
  return keyframe;
}

TEST(SlidingWindow, AKeyframeAfterSomePathOrTurnSinceTheLastOne) {
  WindowOptions options;
  options.keyframe_m = 0.5;
  options.keyframe_rad = 0.05;
  MapState state = EmptyState();
  SlidingWindow window(options, {}, {});
  EXPECT_TRUE(AddFrame(state, window, Pose())) << "the first one";
  EXPECT_FALSE(AddFrame(state, window, Pose::Trans(0, 0, 0.3)));
  EXPECT_FALSE(AddFrame(state, window, Pose::Trans(0, 0, 0.49)));
  EXPECT_TRUE(AddFrame(state, window, Pose::Trans(0, 0, 0.5))) << "not since the last frame";
  const Pose here = Pose::Trans(0, 0, 0.6);
  EXPECT_FALSE(AddFrame(state, window, here * Pose::RotY(0.049)));
  EXPECT_TRUE(AddFrame(state, window, here * Pose::RotY(0.051)));
}

TEST(SlidingWindow, SwitchedOffItMovesNothing) {
  WindowOptions options;
  options.enabled = false;
  MapState state = EmptyState();
  SlidingWindow window(options, {}, {});
  for (int i = 0; i < 20; ++i) AddFrame(state, window, Pose::Trans(0, 0, i));
  const FrameStore::Revision before = state.frames.revision();
  FrameRecord record;
  record.frame = 20;
  record.T_odom_cam = record.T_world_cam = Pose::Trans(0, 0, 20);
  state.frames.Append(record);
  double log_scale = 0.1;
  EXPECT_FALSE(window.AddKeyframe(state, log_scale, 0).usable);
  EXPECT_EQ(log_scale, 0.1);
  EXPECT_EQ(state.frames.FirstChangeSince(before), 20) << "the new frame alone";
}

// Two parked cars ahead with exact detections; the last camera's odometry has an error of 0.2 m.
TEST(SlidingWindow, ObjectsCorrectTheNewestCamera) {
  MapState state = EmptyState();
  std::vector<LandmarkId> cars;
  for (const double x : {-3., 3.}) {
    MapLandmark car;
    car.label = "Car";
    car.state = LandmarkState::kConfirmed;
    car.pose = {Vec3(x, 1, 15), 0};
    car.dims = Vec3(4, 1.7, 1.5);
    cars.push_back(state.map.Insert(car));
  }
  BaOptions ba;
  ba.odometry.translation_walk = 0.3;
  SlidingWindow window({}, ba, {});
  double log_scale = 0;
  BaSummary summary;
  for (int i = 0; i < 8; ++i) {
    const Pose T_world_cam = Pose::Trans(0, 0, i);
    FrameRecord record;
    record.frame = i;
    record.matched = cars;
    record.T_odom_cam = record.T_world_cam = T_world_cam * Pose::Trans(i == 7 ? 0.2 : 0, 0, 0);
    for (const LandmarkId id : cars) {
      Detection detection;
      detection.T_cam_object =
          T_world_cam.inverse() * ToPose(state.map.at(id).pose, state.gravity());
      record.detections.push_back(detection);
      std::vector<Sighting> sightings = state.map.at(id).sightings;
      sightings.push_back({i, 0.1 * i, 0, 1, detection.T_cam_object, Vec3(4, 1.7, 1.5)});
      state.map.SetSightings(id, sightings);
    }
    ASSERT_TRUE(window.IsKeyframe(state.frames, record.T_odom_cam));
    state.frames.Append(record);
    summary = window.AddKeyframe(state, log_scale, 0);
  }
  EXPECT_TRUE(summary.usable);
  EXPECT_LT(std::abs(state.frames.back().T_world_cam.translation().x()), 0.1);
  EXPECT_EQ(state.frames.back().T_odom_cam.translation().x(), 0.2) << "a measurement stays";
}

TEST(PredictPose, TheStepOfTheOdometryScaledGoesOnFromTheEstimate) {
  FrameRecord from;
  from.T_odom_cam = Pose::Trans(0, 0, 10);
  from.T_world_cam = Pose::Trans(1, 0, 0) * Pose::RotY(M_PI / 2);
  const Pose next = PredictPose(from, Pose::Trans(0, 0, 12) * Pose::RotY(0.1), std::log(1.5));
  EXPECT_TRUE(next.translation().isApprox(Vec3(4, 0, 0))) << "3 m along the camera's z axis";
  EXPECT_NEAR((from.T_world_cam.so3().inverse() * next.so3()).Log().norm(), 0.1, 1e-12);
}

}  // namespace
}  // namespace sslcd
