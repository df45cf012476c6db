// SPDX-License-Identifier: BSD-3-Clause
#include "eval/segment_error.h"

#include <gtest/gtest.h>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::vector<Pose> Straight(int frames, double step_m, double turn_rad = 0) {
  std::vector<Pose> poses(1);
  while (static_cast<int>(poses.size()) < frames)
    poses.push_back(poses.back() * Pose::Trans(0, 0, step_m) * Pose::RotY(turn_rad));
  return poses;
}

TEST(SegmentError, OfAScaleIsThatScale) {
  const SegmentError error = ComputeSegmentError(Straight(52, 1.02), Straight(52, 1), {10, 20});
  // The sub-path ends behind its length, at the next frame: 11 and 21 m.
  EXPECT_EQ(error.count, 41 + 31);
  EXPECT_NEAR(error.translation, (41 * 0.02 * 11 / 10 + 31 * 0.02 * 21 / 20) / 72, 1e-12);
  EXPECT_NEAR(error.rotation_rad_per_m, 0, 1e-12);
}

TEST(SegmentError, OfATurn) {
  const SegmentError error = ComputeSegmentError(Straight(52, 1, 1e-3), Straight(52, 1), {10}, 10);
  EXPECT_EQ(error.count, 5) << "from frames 0, 10, ... 40";
  EXPECT_NEAR(error.rotation_rad_per_m, 11e-3 / 10, 1e-12);
}

TEST(SegmentError, TooShortOrEmptyOrUnequal) {
  EXPECT_EQ(ComputeSegmentError(Straight(5, 1), Straight(5, 1), {10}).count, 0);
  EXPECT_EQ(ComputeSegmentError({}, {}, {10}).count, 0);
  EXPECT_THROW(ComputeSegmentError(Straight(5, 1), Straight(6, 1), {10}), Error);
}

}  // namespace
}  // namespace sslcd
