// SPDX-License-Identifier: BSD-3-Clause
#include "render/light.h"

#include <gtest/gtest.h>

namespace sslcd::render {
namespace {

TEST(Daylight, SunStandsWhereTold) {
  const Daylight ahead = MakeDaylight({0, 30, 1, 0}, 1), right = MakeDaylight({90, 30, 1, 0}, 1);
  EXPECT_NEAR((ahead.to_sun - Vec3f(0, std::sqrt(0.75f), 0.5f)).norm(), 0, 1e-6);
  EXPECT_NEAR((right.to_sun - Vec3f(std::sqrt(0.75f), 0, 0.5f)).norm(), 0, 1e-6);
  EXPECT_GT(SkyColour(ahead, ahead.to_sun).minCoeff(),
            3 * SkyColour(ahead, -right.to_sun).maxCoeff());
}

TEST(Daylight, WarmLightIsRedderAndLowSunWeaker) {
  const Daylight cool = MakeDaylight({0, 40, 1, -1}, 1), warm = MakeDaylight({0, 40, 1, 1}, 1),
                 low = MakeDaylight({0, 5, 1, 1}, 1);
  EXPECT_GT(warm.sun.x() / warm.sun.z(), cool.sun.x() / cool.sun.z());
  EXPECT_LT(low.sun.norm(), warm.sun.norm());
}

TEST(Shade, SunAddsSkyRemainsAndGlassMirrorsAtGrazingAngles) {
  const Daylight light = MakeDaylight({0, 60, 1, 0}, 1);
  const Surface matt{Vec3f::Constant(0.3f)};
  const Vec3f up = Vec3f::UnitZ(), down = -up;
  const Vec3f lit = Shade(light, matt, up, down, 1, 1), shaded = Shade(light, matt, up, down, 0, 1);
  EXPECT_GT(lit.minCoeff(), 1.5f * shaded.minCoeff());
  EXPECT_GT(shaded.minCoeff(), 0.01f);
  EXPECT_EQ(Shade(light, matt, up, down, 0, 0).norm(), 0);
  EXPECT_GT(shaded.z(), shaded.x()) << "shade is bluish";
  const Surface glass{Vec3f::Zero(), 0.05f};
  const Vec3f grazing = Vec3f(0, -1, -0.1f).normalized();
  EXPECT_GT(Shade(light, glass, up, grazing, 0, 1).norm(),
            4 * Shade(light, glass, up, down, 0, 1).norm());
}

TEST(Air, FarThingsTakeTheHorizonsColour) {
  const Daylight light = MakeDaylight({0, 60, 1, 0}, 1);
  EXPECT_EQ(ApplyHaze(light, Vec3f::Zero(), 0), Vec3f::Zero());
  EXPECT_LT(ApplyHaze(light, Vec3f::Zero(), 10).norm(),
            ApplyHaze(light, Vec3f::Zero(), 100).norm());
}

}  // namespace
}  // namespace sslcd::render
