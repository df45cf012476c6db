// SPDX-License-Identifier: BSD-3-Clause
#include "render/ground.h"

#include <gtest/gtest.h>

namespace sslcd::render {
namespace {

SurfacePoint On(float x, float y) { return {{x, y, 0}, {0, 0, 1}, 0, 0.02f}; }

/// One parking space at (3, 4) that faces +y, and a world that uses its middle only.
sim::HalvWorld OneSpace() {
  sim::HalvWorld scene;
  scene.world.truth = {{0}, {Pose(lie::SO3<double>(), Vec3(3, 0, 4))}};
  scene.spaces = {{3, 4, 0, 5, 2.6}};
  return scene;
}

TEST(GridIndex, FindsWhatWasPutThereAndNothingBeyond) {
  GridIndex list({-10, -10}, {10, 10}, 2);
  list.Add({-1, -1}, {1, 1}, 7);
  EXPECT_EQ(list.At({0.5f, -0.5f}), std::vector<int>{7});
  EXPECT_TRUE(list.At({5, 5}).empty());
  EXPECT_TRUE(list.At({100, 0}).empty());
  EXPECT_TRUE(list.At({NAN, 0}).empty());
  EXPECT_TRUE(GridIndex().At({0, 0}).empty());
}

TEST(Ground, SpacesHaveLinesOnThreeSides) {
  const sim::HalvWorld scene = OneSpace();
  const Ground ground(scene, FindUsedArea(scene.world), 1);
  const auto brightness = [&](float x0, float y0, float x1,
                              float y1) {  // mean along a line: paint is worn in places
    float sum = 0;
    constexpr int kSteps = 50;
    for (int i = 0; i < kSteps; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) / kSteps;
      sum += ground.At(On(Mix(x0, x1, t), Mix(y0, y1, t))).albedo.mean();
    }
    return sum / kSteps;
  };
  EXPECT_GT(brightness(1.7f, 1.5f, 1.7f, 6.5f), 0.25f) << "left";
  EXPECT_GT(brightness(4.3f, 1.5f, 4.3f, 6.5f), 0.25f) << "right";
  EXPECT_GT(brightness(1.7f, 6.5f, 4.3f, 6.5f), 0.25f) << "front";
  EXPECT_LT(brightness(1.9f, 1.5f, 4.1f, 1.5f), 0.22f) << "open to the aisle";
}

TEST(Ground, IsGreenWhereNothingStandsOrDrives) {
  const sim::HalvWorld scene = OneSpace();
  const Ground ground(scene, FindUsedArea(scene.world), 1);
  const auto green = [&](float x, float y) {
    const Vec3f albedo = ground.At(On(x, y)).albedo;
    return albedo.y() - albedo.z();
  };
  EXPECT_LT(green(6, 0), 0.02f);
  EXPECT_GT(green(40, 40), 0.03f);
  EXPECT_GT(green(4000, -4000), 0.03f);
}

}  // namespace
}  // namespace sslcd::render
