// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/layout_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "layout_cases.h"

namespace sslcd {
namespace {

TEST(LayoutIndex, FindsEverythingWithinReach) {
  const std::vector<LayoutObject> map = Strewn(200, 60, 1);
  const LayoutIndex index(map, 50, 2);
  for (double x = -35; x < 35; x += 1.7) {
    for (double y = -35; y < 35; y += 1.3) {
      std::set<int> found;
      for (const int j : index.Near(x, y)) EXPECT_TRUE(found.insert(j).second) << "listed twice";
      for (int j = 0; j < static_cast<int>(map.size()); ++j)
        EXPECT_TRUE(found.count(j) == 1 || (map[j].position.head<2>() - Vec2(x, y)).norm() > 2);
    }
  }
  EXPECT_TRUE(index.Near(1e9, 0).empty());
  EXPECT_TRUE(index.Near(NAN, 0).empty());
}

TEST(LayoutIndex, FindsAllPairsOfADistance) {
  const std::vector<LayoutObject> map = Strewn(60, 60, 2);
  const LayoutIndex index(map, 40, 2);
  for (const double distance : {1., 10., 39.}) {
    int expected = 0, found = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
      for (std::size_t j = i + 1; j < map.size(); ++j) {
        const double d = (map[i].position - map[j].position).head<2>().norm();
        if (std::minmax(map[i].label, map[j].label) == std::minmax(0, 1)) expected += std::abs(d - distance) < 0.5;
      }
    }
    const auto end = index.PairsEnd(0, 1, distance + 0.5);
    for (auto pair = index.PairsBegin(0, 1, distance - 0.5); pair < end; ++pair) {
      EXPECT_EQ(map[pair->a].label, 0);
      EXPECT_EQ(map[pair->b].label, 1);
      const Vec3 step = map[pair->b].position - map[pair->a].position;
      EXPECT_NEAR(pair->distance * pair->dx, step.x(), 1e-4);
      EXPECT_NEAR(pair->distance * pair->dy, step.y(), 1e-4);
      EXPECT_NEAR(pair->dz, step.z(), 1e-5);
      found += std::abs(pair->distance - distance) < 0.5;
    }
    EXPECT_EQ(found, expected) << distance;
  }
  EXPECT_GE(index.PairsBegin(7, 8, 1), index.PairsEnd(7, 8, 9));
}

TEST(LayoutIndex, TakesOddMaps) {
  EXPECT_TRUE(LayoutIndex({}, 50, 2).Near(0, 0).empty());
  const std::vector<LayoutObject> odd = {ObjectAt({NAN, 0, 0}), ObjectAt({0, INFINITY, 0}), ObjectAt({1, 1, 1})};
  const LayoutIndex index(odd, 50, 2);
  EXPECT_EQ(index.objects().size(), 1u);
  EXPECT_EQ(*index.Near(1, 1).begin(), 0);
  const LayoutIndex far({ObjectAt({0, 0, 0}), ObjectAt({1e7, -1e7, 0})}, 50, 2);  // no memory for what lies between
  EXPECT_FALSE(far.Near(1e7, -1e7).empty());
  const LayoutIndex heap(std::vector<LayoutObject>(20, ObjectAt({3, 3, 3})), 50, 2);
  EXPECT_GE(heap.PairsBegin(0, 0, 0), heap.PairsEnd(0, 0, 50)) << "no direction between equal points";
}

}  // namespace
}  // namespace sslcd
