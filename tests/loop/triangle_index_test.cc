// SPDX-License-Identifier: BSD-3-Clause
#include "loop/triangle_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "layout_cases.h"

namespace sslcd {
namespace {

std::set<std::array<int, 3>> Vertices(const std::vector<ObjectTriangle>& triangles) {
  std::set<std::array<int, 3>> sets;
  for (const ObjectTriangle& triangle : triangles) {
    std::array<int, 3> vertices = triangle.vertex;
    std::sort(vertices.begin(), vertices.end());
    EXPECT_TRUE(sets.insert(vertices).second) << "listed twice";
  }
  return sets;
}

double Difference(const ObjectTriangle& a, const ObjectTriangle& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += (a.side[i] - b.side[i]) * (a.side[i] - b.side[i]);
  return std::sqrt(sum);
}

TEST(NeighbourTriangles, AreTheSameWithAndWithoutAnIndex) {
  const LayoutIndex index(Strewn(150, 100, 1), 50, 2);
  const auto with = Vertices(NeighbourTriangles(index)),
             without = Vertices(NeighbourTriangles(index.points()));
  EXPECT_GT(with.size(), 150u * 5);
  EXPECT_EQ(with, without);
}

TEST(NeighbourTriangles, SignaturesStayInTurnedMaps) {
  const std::vector<LayoutObject> map = Strewn(40, 60, 2);
  const YawShift pose{2.1, {30, -20, 1}};
  const auto a = NeighbourTriangles(LayoutIndex(map, 50, 2).points());
  const auto b =
      NeighbourTriangles(LayoutIndex(SeenFrom(map, pose, {0, 0}, 100, 0, 1), 50, 2).points());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].label, b[i].label);
    EXPECT_NEAR(Difference(a[i], b[i]), 0, 1e-4);
    EXPECT_TRUE(std::is_sorted(a[i].label.begin(), a[i].label.end()));
  }
}

TEST(NeighbourTriangles, TakeFewAndEqualPoints) {
  for (int count = 0; count < 3; ++count)
    EXPECT_TRUE(NeighbourTriangles(LayoutIndex(Strewn(count, 60, 1), 50, 2)).empty());
  const LayoutIndex heap(std::vector<LayoutObject>(20, ObjectAt({3, 3, 3})), 50, 2);
  EXPECT_TRUE(NeighbourTriangles(heap).empty()) << "too short for a yaw";
}

TEST(TriangleIndex, FindsAllOfTheSameSides) {
  const LayoutIndex map(Strewn(300, 150, 3), 50, 2);
  const TriangleIndex index(map);
  const std::vector<ObjectTriangle> all = NeighbourTriangles(map);
  const std::vector<ObjectTriangle> wanted =
      NeighbourTriangles(LayoutIndex(Strewn(30, 50, 4), 50, 2));
  std::size_t total = 0;
  for (const ObjectTriangle& triangle : wanted) {
    std::set<std::array<int, 3>> expected, got;
    for (const ObjectTriangle& other : all)
      if (other.label == triangle.label && Difference(triangle, other) < 1.5)
        expected.insert(other.vertex);
    std::vector<ObjectTriangle> found, again;
    index.Find(map, triangle, 1.5, 1000, found);
    index.Find(map, triangle, 1.5, expected.size(), again);
    EXPECT_EQ(found, again);
    for (const ObjectTriangle& other : found) got.insert(other.vertex);
    EXPECT_EQ(found.size(), got.size());
    EXPECT_EQ(got, expected);
    total += expected.size();
    if (expected.size() < 2) continue;
    found.clear();
    index.Find(map, triangle, 1.5, expected.size() - 1, found);
    EXPECT_TRUE(found.empty()) << "over the limit";
  }
  EXPECT_GT(total, wanted.size());
}

TEST(TriangleIndex, KnowsNoOtherLabels) {
  const LayoutIndex map(Strewn(100, 100, 5), 50, 2);
  ObjectTriangle triangle = NeighbourTriangles(map)[0];
  triangle.label = {7, 8, 9};
  std::vector<ObjectTriangle> found;
  TriangleIndex(map).Find(map, triangle, 1e3, 1000, found);
  EXPECT_TRUE(found.empty());
}

// Objects by place, since indices may differ.
using Corners = std::set<std::array<double, 3>>;

// All triangles of a map as its index has them, by many searches.
std::multiset<Corners> AllTriangles(const LayoutIndex& index) {
  std::multiset<Corners> all;
  for (const ObjectTriangle& triangle : NeighbourTriangles(index)) {
    std::vector<ObjectTriangle> found;
    index.triangles()->Find(index, triangle, 1e-3, 1000, found);
    for (const ObjectTriangle& other : found) {
      Corners corners;
      for (const int i : other.vertex) {
        const Vec3& p = index.objects()[i].position;
        corners.insert({p.x(), p.y(), p.z()});
      }
      all.insert(corners);
    }
  }
  return all;
}

// Crowds and lonely objects: the distances of the neighbours differ by a factor of 100.
TEST(TriangleIndex, UpdatedTrianglesAreThoseOfABuiltIndex) {
  std::mt19937 random(3);
  const auto somewhere = [&](int id) {
    const double spread = id % 5 == 0 ? 2000 : id % 5 == 1 ? 400 : 60;
    LayoutObject object = ObjectAt(
        {spread * (random() % 1000000 * 1e-6 - 0.5), spread * (random() % 1000000 * 1e-6 - 0.5), 0},
        id % 7 == 0 ? -3 : 2);
    object.id = id;
    return object;
  };
  std::map<int, LayoutObject> map;
  for (int id = 0; id < 1000; ++id) map[id] = somewhere(id);
  const auto all = [&] {
    std::vector<LayoutObject> objects;
    for (const auto& [id, object] : map) objects.push_back(object);
    return objects;
  };
  LayoutIndex kept(all(), 50, 2);
  for (int round = 0; round < 300; ++round) {
    std::vector<LayoutObject> changed;
    for (int i = 0; i < 2; ++i) changed.push_back(somewhere(1000 + 2 * round + i));
    const auto moved = std::next(map.begin(), static_cast<std::ptrdiff_t>(random() % map.size()));
    changed.push_back(somewhere(moved->first));
    for (const LayoutObject& object : changed) map[object.id] = object;
    std::vector<int> removed;
    for (int i = 0; i < 2; ++i) {
      const auto gone = std::next(map.begin(), static_cast<std::ptrdiff_t>(random() % map.size()));
      if (gone->first == moved->first || gone->first >= 1000 + 2 * round) continue;
      removed.push_back(gone->first);
      map.erase(gone);
    }
    kept.Update(changed, removed);
    if (round % 60 != 59) continue;
    const LayoutIndex fresh(all(), 50, 2);
    ASSERT_NE(fresh.triangles(), nullptr);
    EXPECT_EQ(AllTriangles(kept), AllTriangles(fresh));
  }
}

}  // namespace
}  // namespace sslcd
