// SPDX-License-Identifier: BSD-3-Clause
#include "core/turning_axis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// A circle with y down, turned into the world by `R`. Cameras shake by `jitter`. [rad]
std::vector<Pose> Circle(const lie::SO3<double>& R, double turned, double jitter = 0) {
  std::vector<Pose> poses;
  for (int i = 0; i < 400; ++i) {
    const Pose shaken =
        Pose::RotX(jitter * std::sin(7. * i)) * Pose::RotZ(jitter * std::cos(5. * i));
    poses.push_back(Pose(R, Vec3::Zero()) * Pose::RotY(turned * i / 399) * Pose::Trans(0, 0, 20) *
                    shaken);
  }
  return poses;
}

TEST(TurningAxis, IsTheVerticalOfAVehicle) {
  for (const double turned : {6., -6.}) {
    const auto axis = TurningAxis(Circle({}, turned, 0.02));
    ASSERT_TRUE(axis.has_value());
    EXPECT_LT((*axis - Vec3(0, -1, 0)).norm(), 0.05) << "up, whichever way it turns";
  }
  const auto axis = TurningAxis(Circle(lie::SO3<double>::RotX(-M_PI / 2), 6));
  ASSERT_TRUE(axis.has_value());
  EXPECT_LT((*axis - Vec3(0, 0, 1)).norm(), 1e-6);
}

TEST(TurningAxis, NeedsTurns) {
  EXPECT_FALSE(TurningAxis({}).has_value());
  EXPECT_FALSE(TurningAxis(Circle({}, 2.8)).has_value());
  EXPECT_TRUE(TurningAxis(Circle({}, 3.6)).has_value());
}

TEST(TurningAxis, NeedsOneAxis) {
  std::vector<Pose> tumbling;
  for (int i = 0; i < 200; ++i)
    tumbling.push_back(Pose::RotX(0.3 * i) * Pose::RotY(0.21 * i) * Pose::RotZ(0.13 * i));
  EXPECT_FALSE(TurningAxis(tumbling).has_value());
  EXPECT_TRUE(MayBeUp({1, 0, 0}, tumbling));
}

TEST(MayBeUp, IsWhatIsWithin60DegreesOfTheAxis) {
  const auto circle = Circle({}, 6);
  EXPECT_TRUE(MayBeUp({0, -1, 0}, circle));
  EXPECT_TRUE(MayBeUp({0, 1, 0}, circle)) << "the sign is not its business";
  EXPECT_TRUE(MayBeUp(Vec3(0, -std::cos(1.0), std::sin(1.0)), circle));
  EXPECT_FALSE(MayBeUp(Vec3(0, -std::cos(1.1), std::sin(1.1)), circle));
}

}  // namespace
}  // namespace sslcd
