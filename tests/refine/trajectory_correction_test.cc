// SPDX-License-Identifier: BSD-3-Clause
#include "refine/trajectory_correction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sslcd {
namespace {

// A camera that drives `step` metres a frame straight ahead, its pose `shift` away from the
// odometry.
FrameStore Drive(int count, double step, const Pose& shift = {}, double turn_rad = 0) {
  FrameStore frames;
  for (int i = 0; i < count; ++i) {
    FrameRecord record;
    record.frame = 10 * i;  // numbers are not indices
    record.stamp = 0.1 * i;
    record.T_odom_cam = Pose::Trans(0, 0, step * i) * Pose::RotY(turn_rad * i);
    record.T_world_cam = shift * record.T_odom_cam;
    frames.Append(record);
  }
  return frames;
}

void MoveAll(FrameStore& frames, const Pose& motion) {
  for (int i = 0; i < frames.size(); ++i) frames.SetPose(i, motion * frames[i].T_world_cam);
}

double Apart(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

TEST(SelectKeyframes, ByDistanceByTurnAndBothEnds) {
  EXPECT_TRUE(SelectKeyframes({}, 1, 0.1).empty());
  EXPECT_EQ(SelectKeyframes(Drive(1, 1), 1, 0.1), std::vector<int>{0});
  EXPECT_EQ(SelectKeyframes(Drive(8, 0.5), 0.99, 0.1), (std::vector<int>{0, 2, 4, 6, 7}));
  EXPECT_EQ(SelectKeyframes(Drive(9, 0.), 1, 0.1), (std::vector<int>{0, 8})) << "a standing camera";
  EXPECT_EQ(SelectKeyframes(Drive(5, 0., {}, 0.06), 1, 0.1), (std::vector<int>{0, 2, 4}));
}

TEST(MoveKeyframes, WithoutCorrectionNothingMoves) {
  FrameStore frames = Drive(20, 0.5, Pose::Trans(3, 1, 2) * Pose::RotY(0.3));
  const std::vector<Pose> before = PosesOf(frames);
  const std::vector<int> keyframes{0, 7, 19};
  MoveKeyframes(frames, keyframes, {before[0], before[7], before[19]});
  for (int i = 0; i < 20; ++i) EXPECT_LE(Apart(frames[i].T_world_cam, before[i]), 1e-9);
  MoveKeyframes(frames, {}, {});
  for (int i = 0; i < 20; ++i)
    EXPECT_LE(Apart(frames[i].T_world_cam, before[i]), 1e-9) << "no keyframe, no move";
}

TEST(MoveKeyframes, ACorrectionIsSharedByPath) {
  FrameStore frames = Drive(11, 1.);
  const Pose corrected = frames[10].T_world_cam * Pose::Trans(2, 0, 0);
  MoveKeyframes(frames, {0, 10}, {frames[0].T_world_cam, corrected});
  for (int i = 0; i <= 10; ++i) EXPECT_NEAR(frames[i].T_world_cam.translation().x(), 0.2 * i, 1e-6);
  EXPECT_LE(Apart(frames[10].T_world_cam, corrected), 1e-9);
}

TEST(MoveKeyframes, TheTrajectoryStaysSmoothFarFromTheOrigin) {
  FrameStore frames = Drive(21, 1., Pose::Trans(1000, 0, -500) * Pose::RotY(2.));
  const std::vector<Pose> before = PosesOf(frames);
  MoveKeyframes(frames, {0, 10, 20},
                {before[0], before[10] * Pose::RotY(0.1),
                 before[20] * Pose::RotY(0.3) * Pose::Trans(0.5, 0, 0)});
  for (int i = 1; i <= 20; ++i) {
    const Pose step = frames[i - 1].T_world_cam.inverse() * frames[i].T_world_cam;
    EXPECT_LE(Apart(step, Pose::Trans(0, 0, 1)), 0.25) << i;
  }
}

TEST(MoveKeyframes, TheEndsMoveRigidly) {
  FrameStore frames = Drive(9, 1.);
  const std::vector<Pose> before = PosesOf(frames);
  const Pose moved = Pose::Trans(1, 0, 0) * Pose::RotY(0.2) * before[3];
  MoveKeyframes(frames, {3}, {moved});
  for (int i = 0; i < 9; ++i)
    EXPECT_LE(Apart(frames[i].T_world_cam, moved * before[3].inverse() * before[i]), 1e-9) << i;
}

struct World {
  MapState state{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), Drive(20, 1.)};
  ObjectMap& map = state.map;
  FrameStore& frames = state.frames;

  // A car that the given frames saw without error.
  LandmarkId Add(const UprightPose& pose, const std::vector<int>& seen_from) {
    MapLandmark landmark;
    landmark.label = "Car";
    landmark.state = LandmarkState::kConfirmed;
    landmark.pose = pose;
    for (const int i : seen_from)
      landmark.sightings.push_back({frames[i].frame, frames[i].stamp, 0, 1.,
                                    frames[i].T_world_cam.inverse() * ToPose(pose, map.gravity()),
                                    Vec3(4, 2, 1.5)});
    return map.Insert(landmark);
  }
};

TEST(MoveObjects, FollowTheirCamerasRigidly) {
  World world;
  const UprightPose pose{Vec3(5, 1, 12), 0.4};
  const LandmarkId id = world.Add(pose, {2, 3, 4});
  const std::vector<Pose> before = PosesOf(world.frames);
  const Pose motion = Pose::Trans(3, 0, -2) * Pose::RotY(0.5);
  MoveAll(world.frames, motion);
  MoveObjects(world.state, before, {});
  const UprightPose expected =
      ToUpright(motion * ToPose(pose, world.map.gravity()), world.map.gravity());
  EXPECT_LE((world.map.at(id).pose.position - expected.position).norm(), 1e-9);
  EXPECT_NEAR(WrapAngle(world.map.at(id).pose.yaw - expected.yaw), 0, 1e-9);
}

TEST(MoveObjects, TheNearerCameraCountsMore) {
  World world;
  const LandmarkId id = world.Add({Vec3(0, 1, 20), 0}, {0, 18});
  const std::vector<Pose> before = PosesOf(world.frames);
  world.frames.SetPose(18, Pose::Trans(1, 0, 0) * world.frames[18].T_world_cam);
  MoveObjects(world.state, before, {});
  EXPECT_GT(world.map.at(id).pose.position.x(), 0.6);
  EXPECT_LT(world.map.at(id).pose.position.x(), 1.);
}

TEST(MoveObjects, WhatNoFrameSawStays) {
  World world;
  const LandmarkId id = world.Add({Vec3(0, 1, 20), 0.3}, {});
  const std::vector<Pose> before = PosesOf(world.frames);
  MoveAll(world.frames, Pose::Trans(9, 0, 0));
  MoveObjects(world.state, before, {});
  EXPECT_EQ(world.map.at(id).pose.position, Vec3(0, 1, 20));
  world.frames = {};
  MoveObjects(world.state, {}, {});
  EXPECT_EQ(world.map.at(id).pose.position, Vec3(0, 1, 20));
}

// Straight ahead, a metre a frame, but in place where the odometry is lost.
FrameStore LostDrive(int count, const std::set<int>& lost) {
  FrameStore frames(100);
  double at_m = 0;
  for (int i = 0; i < count; ++i) {
    const bool is_lost = lost.count(i) > 0;
    if (i > 0 && !is_lost) at_m += 1;
    FrameRecord record;
    record.T_odom_cam = record.T_world_cam = Pose::Trans(0, 0, at_m);
    frames.Append(record, is_lost ? std::optional(StepUncertainty{true}) : std::nullopt);
  }
  return frames;
}

TEST(SelectKeyframes, OnEitherSideOfALostStretch) {
  EXPECT_EQ(SelectKeyframes(LostDrive(12, {4}), 100, 1), (std::vector<int>{0, 3, 4, 11}));
  EXPECT_EQ(SelectKeyframes(LostDrive(12, {4, 5, 6}), 100, 1), (std::vector<int>{0, 3, 6, 11}));
  EXPECT_EQ(SelectKeyframes(LostDrive(12, {10, 11}), 100, 1), (std::vector<int>{0, 9, 11}));
}

TEST(MoveKeyframes, ACorrectionOfALostStretchMovesNothingBeforeIt) {
  FrameStore frames = LostDrive(12, {4, 5, 6});
  const std::vector<Pose> before = PosesOf(frames);
  const std::vector<int> keyframes = SelectKeyframes(frames, 100, 1);
  const Pose moved = Pose::Trans(50, 0, 0) * Pose::RotY(2);
  std::vector<Pose> poses;
  for (const int k : keyframes) poses.push_back(k < 4 ? before[k] : moved * before[k]);
  MoveKeyframes(frames, keyframes, poses);
  for (int i = 0; i < 12; ++i) {
    if (i == 4 || i == 5) continue;  // between both
    EXPECT_LE(Apart(frames[i].T_world_cam, (i < 4 ? Pose() : moved) * before[i]), 1e-6) << i;
  }
}

}  // namespace
}  // namespace sslcd
