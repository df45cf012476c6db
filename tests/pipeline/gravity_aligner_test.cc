// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/gravity_aligner.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// How far the camera's y axis is from straight down. [rad]
double Tilt(const Pose& T_world_cam) {
  return std::acos(std::min(1., (T_world_cam.so3() * Vec3(0, 1, 0)).y()));
}

// A kilometre of which each metre tilts the camera sideways by `rad_per_m`.
Pose LastOfATiltingDrive(double rad_per_m, const LevelOptions& options) {
  GravityAligner aligner({}, options);
  Pose last;
  for (int i = 0; i <= 1000; ++i)
    last = aligner.Align(Pose(lie::SO3<double>::RotZ(i * rad_per_m), Vec3(0, 0, i)));
  return last;
}

TEST(GravityAligner, LevelOdometryPassesUnchanged) {
  GravityAligner aligner({}, {});
  for (int i = 0; i < 500; ++i) {
    const Pose T(
        lie::SO3<double>::RotY(0.01 * i) * lie::SO3<double>::RotX(0.05 * std::sin(0.1 * i)),
        Vec3(50 * std::cos(0.01 * i), 0, i));
    EXPECT_NEAR((aligner.Align(T).inverse() * T).Log().norm(), 0, 1e-9) << i;
  }
}

TEST(GravityAligner, TurnsDriftBackToTheSteepestSlope) {
  const LevelOptions options;
  for (const double rad_per_m : {3e-4, 5e-4}) {
    // The excess of the mean, over the window, corrects as much as the drift adds.
    const double tilt = options.max_slope_rad + rad_per_m * options.window_m;
    EXPECT_NEAR(Tilt(LastOfATiltingDrive(rad_per_m, options)), tilt, 0.15 * tilt);
  }
}

TEST(GravityAligner, CanBeSwitchedOff) {
  LevelOptions options;
  options.enabled = false;
  EXPECT_NEAR(Tilt(LastOfATiltingDrive(5e-4, options)), 0.5, 1e-9);
}

TEST(GravityAligner, AShortTiltIsNoDrift) {
  GravityAligner aligner({}, {});
  for (int i = 0; i < 300; ++i) {
    const bool ramp = i > 150 && i < 170;  // 20 m at 0.3 rad, of a window of 200 m
    const Pose T(lie::SO3<double>::RotX(ramp ? 0.3 : 0), Vec3(0, 0, i));
    EXPECT_NEAR((aligner.Align(T).inverse() * T).Log().norm(), 0, 1e-9) << i;
  }
}

TEST(GravityAligner, StepsKeepTheirLengthAndAStandstillChangesNothing) {
  GravityAligner aligner({}, {});
  Pose last = aligner.Align(Pose());
  for (int i = 1; i <= 800; ++i) {
    const Pose next = aligner.Align(Pose(lie::SO3<double>::RotX(-1e-3 * i), Vec3(0, 0, i)));
    EXPECT_NEAR((next.translation() - last.translation()).norm(), 1, 1e-9);
    last = next;
  }
  for (int i = 0; i < 5; ++i) {
    const Pose next = aligner.Align(Pose(lie::SO3<double>::RotX(-0.8), Vec3(0, 0, 800)));
    EXPECT_NEAR((last.inverse() * next).Log().norm(), 0, 1e-9);
  }
}

TEST(GravityAligner, TheFirstCameraSaysWhichOfItsAxesIsUp) {
  GravityFrame z_up = GravityFrame::FromUp(Vec3(0, 0, 1));
  GravityAligner aligner(z_up, {});
  // camera axes in a world whose z points up
  const lie::SO3<double> R = lie::SO3<double>::RotX(-M_PI / 2);
  for (int i = 0; i < 400; ++i) {
    const Pose T(R, Vec3(0, i, 0));
    EXPECT_NEAR((aligner.Align(T).inverse() * T).Log().norm(), 0, 1e-9);
  }
}

}  // namespace
}  // namespace sslcd
