// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_edge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// Two frames whose odometry and estimate have different world frames.
FrameStore TwoFrames() {
  FrameStore frames;
  for (int i = 0; i < 2; ++i) {
    FrameRecord record;
    record.T_odom_cam = Pose::Trans(0, 0, 4. * i) * Pose::RotY(0.2 * i);
    record.T_world_cam = Pose::RotY(1) * Pose::Trans(5, 0, 0) * record.T_odom_cam;
    frames.Append(record);
  }
  return frames;
}

const Vec3 kUp(0, -1, 0);

TEST(OdometryBetween, IsTheStepOfTheOdometryMadeMetric) {
  const FrameStore frames = TwoFrames();
  const OdometryEdge edge = OdometryBetween(frames, 0, 1, {}, kUp, 1.5);
  EXPECT_TRUE(edge.T_from_to.translation().isApprox(Vec3(0, 0, 6)));
  EXPECT_NEAR(edge.T_from_to.so3().Log().norm(), 0.2, 1e-12) << "a scale turns nothing";
  const OdometryEdge back = OdometryBetween(frames, 1, 0, {}, kUp, 1.5);
  EXPECT_LT((back.T_from_to * edge.T_from_to).Log().norm(), 1e-12);
}

TEST(OdometryBetween, InformationIsThatOfItsNoise) {
  const FrameStore frames = TwoFrames();
  OdometryNoise noise;
  noise.vertical_walk = 3 * noise.translation_walk;
  const OdometryEdge edge = OdometryBetween(frames, 0, 1, {noise, {}}, kUp, 1);
  const OdometrySigmas sigmas = SigmasOf(edge.T_from_to, noise);
  EXPECT_NEAR(edge.information(1, 1), 1 / std::pow(sigmas.vertical, 2), 1e-6) << "y is vertical";
  EXPECT_NEAR(edge.information(0, 0), 1 / std::pow(sigmas.horizontal, 2), 1e-6);
  EXPECT_NEAR(edge.information(4, 4), 1 / std::pow(sigmas.rotation, 2), 1e-3);
  const RelativePose measured = edge.Measurement();
  EXPECT_NEAR(measured.covariance(1, 1), std::pow(sigmas.vertical, 2), 1e-12);
}

TEST(OdometryBetween, UpIsTurnedIntoTheSecondCamera) {
  FrameStore frames;
  for (int i = 0; i < 2; ++i) {  // a camera that looks along gravity: its z axis is vertical
    FrameRecord record;
    record.T_odom_cam = Pose::Trans(0, 0, 4. * i);
    record.T_world_cam = Pose::RotX(M_PI / 2) * record.T_odom_cam;
    frames.Append(record);
  }
  OdometryNoise noise;
  noise.vertical_walk = 3 * noise.translation_walk;
  const OdometryEdge edge = OdometryBetween(frames, 0, 1, {noise, {}}, kUp, 1);
  EXPECT_LT(edge.information(2, 2), 0.5 * edge.information(1, 1));
}

TEST(OdometryBetween, ALostStepHoldsTheCurrentPoses) {
  FrameStore frames;
  for (int i = 0; i < 3; ++i) {
    FrameRecord record;
    record.T_odom_cam = Pose::Trans(0, 0, i);
    record.T_world_cam = Pose::Trans(7 * i, 0, 0);
    frames.Append(record, StepUncertainty{i == 2});
  }
  const Vec3 up(0, -1, 0);
  EXPECT_EQ(OdometryBetween(frames, 0, 1, {}, up, 2).T_from_to.translation(), Vec3(0, 0, 2));
  const OdometryEdge lost = OdometryBetween(frames, 0, 2, {}, up, 2);
  EXPECT_EQ(lost.T_from_to.translation(), Vec3(14, 0, 0));
  EXPECT_LT(lost.information.diagonal().maxCoeff(), 1);
}

}  // namespace
}  // namespace sslcd
