// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/pose_buffer.h"

#include <gtest/gtest.h>

namespace sslcd::ros_bridge {
namespace {

using Added = PoseBuffer::Added;
using Found = PoseBuffer::Found;

constexpr Stamp kSecond = 1000000000;
constexpr Stamp kStart = 1700000000 * kSecond;  // of today's clocks

TEST(PoseBuffer, InterpolatesTranslationAndRotation) {
  PoseBuffer poses(10, 0.5);
  poses.Add(kStart, Pose::Trans(1, 0, 0));
  poses.Add(kStart + kSecond / 5, Pose::Trans(2, 0, 0));
  poses.Add(kStart + 2 * kSecond / 5, Pose::Trans(2, 0, 0) * Pose::RotZ(1));
  const PoseBuffer::Answer moved = poses.At(kStart + kSecond / 20);
  EXPECT_EQ(moved.found, Found::kYes);
  EXPECT_NEAR(moved.T_odom_base.translation().x(), 1.25, 1e-9);
  const PoseBuffer::Answer turned = poses.At(kStart + 3 * kSecond / 10);
  EXPECT_LT((turned.T_odom_base.inverse() * Pose::Trans(2, 0, 0) * Pose::RotZ(0.5)).Log().norm(),
            1e-9);
  EXPECT_EQ(poses.At(kStart + kSecond / 5).T_odom_base.translation().x(), 2) << "exact";
}

TEST(PoseBuffer, SaysWhyThereIsNoPose) {
  PoseBuffer poses(1, 0.5);
  EXPECT_EQ(poses.At(kStart).found, Found::kNotYet) << "nothing yet";
  poses.Add(kStart, Pose());
  EXPECT_EQ(poses.At(kStart - 1).found, Found::kTooOld);
  EXPECT_EQ(poses.At(kStart).found, Found::kYes);
  EXPECT_EQ(poses.At(kStart + 1).found, Found::kNotYet);
  poses.Add(kStart + 6 * kSecond / 10, Pose());
  EXPECT_EQ(poses.At(kStart + kSecond / 10).found, Found::kGap);
  EXPECT_EQ(poses.At(kStart + 6 * kSecond / 10).found, Found::kYes);
  poses.Add(kStart + 11 * kSecond / 10, Pose());
  EXPECT_EQ(poses.At(kStart).found, Found::kTooOld) << "older than the span";
}

TEST(PoseBuffer, KeepsOrder) {
  PoseBuffer poses(10, 0.5);
  EXPECT_EQ(poses.Add(kStart, Pose()), Added::kYes);
  EXPECT_EQ(poses.Add(kStart, Pose::Trans(5, 0, 0)), Added::kDuplicate);
  EXPECT_EQ(poses.At(kStart).T_odom_base.translation().x(), 0);
  EXPECT_EQ(poses.Add(kStart - kSecond / 2, Pose()), Added::kOutOfOrder);
  EXPECT_EQ(poses.Add(kStart - kSecond, Pose()), Added::kJumpsBack);
  EXPECT_EQ(poses.Add(0, Pose()), Added::kJumpsBack) << "a stamp that nobody has set";
  EXPECT_EQ(poses.newest(), kStart);
  poses.Clear();
  EXPECT_FALSE(poses.newest());
  EXPECT_EQ(poses.Add(0, Pose()), Added::kYes);
}

TEST(PoseBuffer, ABreakIsNotBridged) {
  PoseBuffer poses(10, 0.5);
  poses.Add(kStart, Pose());
  poses.Break();
  EXPECT_EQ(poses.Add(kStart - kSecond, Pose()), Added::kJumpsBack) << "time is known still";
  EXPECT_EQ(poses.Add(kStart + 2, Pose()), Added::kYes);
  EXPECT_EQ(poses.At(kStart + 1).found, Found::kTooOld);
}

}  // namespace
}  // namespace sslcd::ros_bridge
