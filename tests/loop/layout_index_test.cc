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

TEST(LayoutIndex, VisitsABoxOnce) {
  std::vector<LayoutObject> map = Strewn(200, 90, 3);
  map.push_back(ObjectAt({1e12, -1e12, 0}));
  const LayoutIndex index(map, 50, 2);
  for (const double half : {0., 3., 25., 1e300}) {
    const Vec2 low(-12 - half, 4 - half), high(-12 + half, 4 + half);
    std::set<int> visited;
    index.VisitBox(low, high, [&](int j) { EXPECT_TRUE(visited.insert(j).second) << "visited twice"; });
    for (int j = 0; j < static_cast<int>(map.size()); ++j) {
      const Vec2 p = map[j].position.head<2>();
      const bool inside = (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
      EXPECT_TRUE(visited.count(j) == 1 || !inside) << half;
    }
    EXPECT_LT(visited.size(), half < 1 ? 20u : 202u);
  }
  index.VisitBox(Vec2(NAN, 0), Vec2(1, 1), [](int) { ADD_FAILURE(); });
  index.VisitBox(Vec2(1, 1), Vec2(-30, -30), [](int) { ADD_FAILURE(); });
}

TEST(LayoutIndex, KnowsItsRim) {
  const LayoutIndex index({ObjectAt({5, 5, 0}), ObjectAt({-205, 5, 0})}, 50, 2);
  EXPECT_TRUE(index.Known(5, 5));
  EXPECT_TRUE(index.Known(-4, 14));
  EXPECT_TRUE(index.Known(-210, 12));
  EXPECT_FALSE(index.Known(26, 5));
  EXPECT_FALSE(index.Known(-100, 5));
  EXPECT_FALSE(index.Known(NAN, 5));
}

TEST(LayoutIndex, ManyLabelsCostNoPair) {
  std::vector<LayoutObject> map;
  for (int i = 0; i < 400; ++i) map.push_back(ObjectAt({3. * i, 0, 0}, 7 * i));
  const LayoutIndex index(map, 50, 2);
  for (const int i : {0, 200, 390}) {
    bool found = false;
    const auto end = index.PairsEnd(7 * i, 7 * (i + 2), 6.1);
    for (auto pair = index.PairsBegin(7 * i, 7 * (i + 2), 5.9); pair < end; ++pair)
      found |= pair->a == i && pair->b == i + 2;
    EXPECT_TRUE(found) << i;
  }
}

TEST(LayoutIndex, LargeMapsHaveTrianglesInsteadOfPairs) {
  const LayoutIndex small(Strewn(300, 200, 6), 50, 2), large(Strewn(3000, 632, 6), 50, 2);
  EXPECT_EQ(small.triangles(), nullptr);
  EXPECT_LT(small.PairsBegin(0, 0, 10), small.PairsEnd(0, 0, 20));
  EXPECT_NE(large.triangles(), nullptr);
  EXPECT_GE(large.PairsBegin(0, 0, 10), large.PairsEnd(0, 0, 20));
  EXPECT_NEAR(small.density(), large.density(), 0.15 * large.density());
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
