// SPDX-License-Identifier: BSD-3-Clause
#include "core/silhouette.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// A cube with an edge of 2 m at a bearing and a distance, turned as the camera.
Silhouette Cube(double bearing, double range) {
  return SilhouetteOf(
      Pose(lie::SO3<double>(), Vec3(range * std::sin(bearing), 0, range * std::cos(bearing))),
      Vec3(2, 2, 2));
}

TEST(Silhouette, CoversTheCornersOfTheCuboid) {
  // axes of the object are those of the camera: x to the right, y down, so its depth is 0 here
  const Silhouette ahead = Cube(0, 10);
  EXPECT_NEAR(ahead.left, -std::atan2(1., 10), 1e-12);
  EXPECT_NEAR(ahead.right, std::atan2(1., 10), 1e-12);
  EXPECT_NEAR(ahead.range, 10, 1e-12);
}

TEST(Silhouette, IsAShortIntervalBehindTheCamera) {
  const Silhouette behind = Cube(M_PI, 10);
  EXPECT_NEAR(behind.right - behind.left, 2 * std::atan2(1., 10), 1e-12);
  EXPECT_NEAR(0.5 * (behind.right + behind.left), M_PI, 1e-12);
}

TEST(Silhouette, OnlyNearerObjectsHide) {
  for (const double bearing : {0., 1., M_PI, -2.}) {
    const Silhouette far = Cube(bearing, 20), near = Cube(bearing, 5);
    EXPECT_EQ(VisibleFraction(far, {far, near}), 0) << bearing;
    EXPECT_EQ(VisibleFraction(near, {far, near}), 1) << bearing;
    EXPECT_EQ(VisibleFraction(far, {Cube(bearing + 1, 5)}), 1) << bearing;
  }
}

TEST(Silhouette, HalfAnObjectIsHalfVisible) {
  const Silhouette far{-0.1, 0.1, 20};
  EXPECT_EQ(VisibleFraction(far, {{0, 0.3, 10}}), 0.5);
  EXPECT_EQ(VisibleFraction(far, {{0, 0.3, 10}, {-0.2, 0, 10}}), 0);
  EXPECT_EQ(VisibleFraction({M_PI - 0.1, M_PI + 0.1, 20}, {{-M_PI - 0.2, -M_PI, 10}}), 0.5);
}

}  // namespace
}  // namespace sslcd
