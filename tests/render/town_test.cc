// SPDX-License-Identifier: BSD-3-Clause
#include "render/town.h"

#include <gtest/gtest.h>

namespace sslcd::render {
namespace {

float Distance(const Building& building, const Vec2f& place) {
  const Vec2f nearest = place.cwiseMax(building.low.head<2>()).cwiseMin(building.high.head<2>());
  return (place - nearest).norm();
}

TEST(Town, LeavesRoomForAllThatStandsOrDrives) {
  for (const char* layout : {"lot", "street"}) {
    for (int number = 1; number <= 4; ++number) {
      sim::HalvScene scene;
      scene.case_number = number;
      scene.layout = layout;
      const UsedArea used = FindUsedArea(sim::MakeHalvWorld(number, scene).world);
      const Town town = MakeTown(used, 1);
      EXPECT_GT(town.buildings.size(), 40u);
      EXPECT_FALSE(town.trees.empty());
      for (const Building& building : town.buildings) {
        for (const Vec2f& place : used.places)
          ASSERT_GE(Distance(building, place), building.wall ? 3.4f : 7.9f);
      }
    }
  }
}

TEST(Town, SameSeedSameTown) {
  const UsedArea used{{Vec2f(0, 0)}, {-20, -20}, {20, 20}};
  const Town a = MakeTown(used, 1), b = MakeTown(used, 1), c = MakeTown(used, 2);
  ASSERT_EQ(a.buildings.size(), b.buildings.size());
  EXPECT_EQ(a.buildings.back().high, b.buildings.back().high);
  EXPECT_NE(a.buildings.back().high, c.buildings.back().high);
}

TEST(Town, HousesHaveWindowsAndWallsBricks) {
  const UsedArea used{{Vec2f(0, 0)}, {-20, -20}, {20, 20}};
  const Town town = MakeTown(used, 1);
  for (std::size_t i = 0; i < town.buildings.size(); ++i) {
    const Building& building = town.buildings[i];
    if (building.wall || building.high.z() < 6) continue;
    int mirrors = 0, walls = 0;
    for (float x = building.low.x(); x < building.high.x(); x += 0.2f) {
      for (float z = 0.2f; z < building.high.z(); z += 0.2f) {
        const SurfacePoint point{{x, building.low.y(), z}, {0, -1, 0}, static_cast<int>(i), 0.01f};
        const Surface surface = TownSurface(town, point);
        EXPECT_GE(surface.albedo.minCoeff(), 0);
        EXPECT_LE(surface.albedo.maxCoeff(), 1);
        ++(surface.reflectivity > 0.05f ? mirrors : walls);
      }
    }
    EXPECT_GT(mirrors, walls / 20);
    EXPECT_LT(mirrors, walls);
  }
}

}  // namespace
}  // namespace sslcd::render
