// SPDX-License-Identifier: BSD-3-Clause
#include "loop/layout_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "changing_map.h"
#include "loop/raster_search.h"
#include "loop/triangle_index.h"
#include "row_cases.h"

namespace sslcd {
namespace {

TEST(LayoutIndex, FindsEverythingWithinReach) {
  const std::vector<LayoutObject> map = Strewn(200, 60, 1);
  const LayoutIndex index(map, 50, 2);
  for (double x = -35; x < 35; x += 1.7) {
    for (double y = -35; y < 35; y += 1.3) {
      std::set<int> found;
      for (const int j : index.FindWithinReach(x, y))
        EXPECT_TRUE(found.insert(j).second) << "listed twice";
      for (int j = 0; j < static_cast<int>(map.size()); ++j)
        EXPECT_TRUE(found.count(j) == 1 || (map[j].position.head<2>() - Vec2(x, y)).norm() > 2);
    }
  }
  EXPECT_TRUE(index.FindWithinReach(1e9, 0).empty());
  EXPECT_TRUE(index.FindWithinReach(NAN, 0).empty());
}

TEST(LayoutIndex, FindsAllPairsOfADistance) {
  const std::vector<LayoutObject> map = Strewn(60, 60, 2);
  const LayoutIndex index(map, 40, 2);
  for (const double distance : {1., 10., 39.}) {
    int expected = 0, found = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
      for (std::size_t j = i + 1; j < map.size(); ++j) {
        const double d = (map[i].position - map[j].position).head<2>().norm();
        if (std::minmax(map[i].label, map[j].label) == std::minmax(0, 1))
          expected += std::abs(d - distance) < 0.5;
      }
    }
    for (const ObjectPair& pair : index.pairs().Between(0, 1, distance - 0.5, distance + 0.5)) {
      EXPECT_EQ(map[pair.a].label, 0);
      EXPECT_EQ(map[pair.b].label, 1);
      const Vec3 step = map[pair.b].position - map[pair.a].position;
      EXPECT_NEAR(pair.distance * pair.dx, step.x(), 1e-4);
      EXPECT_NEAR(pair.distance * pair.dy, step.y(), 1e-4);
      EXPECT_NEAR(pair.dz, step.z(), 1e-5);
      found += std::abs(pair.distance - distance) < 0.5;
    }
    EXPECT_EQ(found, expected) << distance;
  }
  EXPECT_TRUE(index.pairs().Between(7, 8, 1, 9).empty());
}

TEST(LayoutIndex, VisitsABoxOnce) {
  std::vector<LayoutObject> map = Strewn(200, 90, 3);
  map.push_back(ObjectAt({1e12, -1e12, 0}));
  const LayoutIndex index(map, 50, 2);
  for (const double half : {0., 3., 25., 1e300}) {
    const Vec2 low(-12 - half, 4 - half), high(-12 + half, 4 + half);
    std::set<int> visited;
    index.VisitBox(low, high,
                   [&](int j) { EXPECT_TRUE(visited.insert(j).second) << "visited twice"; });
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
  EXPECT_TRUE(index.IsMapped(5, 5));
  EXPECT_TRUE(index.IsMapped(-4, 14));
  EXPECT_TRUE(index.IsMapped(-210, 12));
  EXPECT_FALSE(index.IsMapped(26, 5));
  EXPECT_FALSE(index.IsMapped(-100, 5));
  EXPECT_FALSE(index.IsMapped(NAN, 5));
}

TEST(LayoutIndex, IsMappedAlikeInABlock) {
  const LayoutIndex index(Strewn(40, 120, 8), 50, 2);
  std::map<std::uint64_t, bool> blocks;
  for (double x = -90; x < 90; x += 1.7)
    for (double y = -90; y < 90; y += 1.3)
      EXPECT_EQ(blocks.insert({index.BlockOf(x, y), index.IsMapped(x, y)}).first->second,
                index.IsMapped(x, y));
}

TEST(LayoutIndex, KnowsTheRimOfThen) {
  LayoutObject late = ObjectAt({5, 5, 0});
  late.since_m = 100;
  const LayoutIndex index({late}, 50, 2);
  EXPECT_TRUE(index.IsMapped(5, 5));
  EXPECT_TRUE(index.IsMapped(5, 5, 100.1));
  EXPECT_FALSE(index.IsMapped(5, 5, 100));
}

TEST(LayoutIndex, ManyLabelsCostNoPair) {
  std::vector<LayoutObject> map;
  for (int i = 0; i < 400; ++i) map.push_back(ObjectAt({3. * i, 0, 0}, 7 * i));
  const LayoutIndex index(map, 50, 2);
  for (const int i : {0, 200, 390}) {
    const PairIndex::Range near = index.pairs().Between(7 * i, 7 * (i + 2), 5.9, 6.1);
    EXPECT_TRUE(std::any_of(near.begin(), near.end(),
                            [&](const ObjectPair& p) { return p.a == i && p.b == i + 2; }));
  }
}

TEST(LayoutIndex, LargeMapsHaveTrianglesInsteadOfPairs) {
  const LayoutIndex small(Strewn(300, 200, 6), 50, 2), large(Strewn(3000, 632, 6), 50, 2);
  EXPECT_EQ(small.triangles(), nullptr);
  EXPECT_FALSE(small.pairs().Between(0, 0, 10, 20).empty());
  EXPECT_NE(large.triangles(), nullptr);
  EXPECT_TRUE(large.pairs().Between(0, 0, 10, 20).empty());
  EXPECT_NEAR(small.density(), large.density(), 0.15 * large.density());
}

// Indices may differ: objects are told apart by their ids.
std::set<int> Ids(const LayoutIndex& index, const std::vector<int>& found) {
  std::set<int> ids;
  for (const int i : found) EXPECT_TRUE(ids.insert(index.objects()[i].id).second) << "listed twice";
  return ids;
}

// By their corners' places: of objects on one spot it does not matter which are neighbours.
using PlacedTriangle = std::pair<std::set<std::pair<float, float>>, std::array<float, 3>>;

std::multiset<PlacedTriangle> Found(const LayoutIndex& index, const ObjectTriangle& triangle) {
  std::vector<ObjectTriangle> found;
  index.triangles()->Find(index, triangle, 1., 100000, found);
  std::multiset<PlacedTriangle> placed;
  std::set<std::set<int>> ids;
  for (const ObjectTriangle& other : found) {
    EXPECT_TRUE(ids.insert(Ids(index, {other.vertex.begin(), other.vertex.end()})).second);
    PlacedTriangle one{{}, other.side};
    for (const int i : other.vertex) one.first.insert({index.points()[i].x, index.points()[i].y});
    placed.insert(std::move(one));
  }
  return placed;
}

void ExpectSameAnswers(const LayoutIndex& kept, const LayoutIndex& fresh, double half_side_m) {
  ASSERT_EQ(kept.objects().size(), fresh.objects().size());
  ASSERT_EQ(kept.triangles() == nullptr, fresh.triangles() == nullptr);
  EXPECT_EQ(kept.density(), fresh.density());
  EXPECT_EQ(kept.height_spread(), fresh.height_spread());
  EXPECT_EQ(kept.counts().labels, fresh.counts().labels);
  EXPECT_EQ(kept.counts().headings, fresh.counts().headings);
  const double step = half_side_m / 12;
  for (double x = -half_side_m; x < half_side_m; x += step) {
    for (double y = -half_side_m; y < half_side_m; y += step) {
      std::vector<int> near[2], box[2];
      for (const int side : {0, 1}) {
        const LayoutIndex& index = side == 0 ? kept : fresh;
        for (const int i : index.FindWithinReach(x, y)) near[side].push_back(i);
        index.VisitBox({x, y}, {x + step, y + 2 * step}, [&](int i) { box[side].push_back(i); });
      }
      EXPECT_EQ(Ids(kept, near[0]), Ids(fresh, near[1]));
      EXPECT_EQ(Ids(kept, box[0]), Ids(fresh, box[1]));
      EXPECT_EQ(kept.IsMapped(x, y), fresh.IsMapped(x, y));
    }
  }
  ASSERT_EQ(kept.tiles() == nullptr, fresh.tiles() == nullptr);
  if (fresh.triangles() == nullptr) return;
  for (const ObjectTriangle& triangle : NeighbourTriangles(LayoutIndex(Strewn(12, 50, 9), 50, 2)))
    EXPECT_EQ(Found(kept, triangle), Found(fresh, triangle));
}

// The poses of a car park's corner in a large map, in a fixed order.
std::vector<std::array<float, 5>> PosesIn(const LayoutIndex& index) {
  Vec3 centre;
  const std::vector<LayoutPoint> points =
      CentredPoints(SeenFrom(CarParks(4, 7), {0.4, {1, 2, 0}}, {3, 2}, 14, 0.2, 1), centre);
  std::vector<std::array<float, 5>> poses;
  for (const CoarsePose& p : SearchRasters(points, index, 300).poses)
    poses.push_back({p.score, p.x, p.y, p.cosine, p.sine});
  std::sort(poses.begin(), poses.end());
  return poses;
}

TEST(LayoutIndex, AnswersAfterUpdatesAsABuiltOneDoes) {
  for (const int count : {60, 2500}) {
    const double side = std::sqrt(count / 0.0075);
    ChangingMap map(count, side);
    LayoutIndex kept(map.All(), 50, 2);
    for (int round = 0; round < 30; ++round) {
      std::vector<LayoutObject> changed = map.Change();
      const std::vector<int> removed = map.Remove(changed);
      if (round == 20) map.AddHeap(changed);
      kept.Update(changed, removed);
      if (round % 5 == 0) ExpectSameAnswers(kept, LayoutIndex(map.All(), 50, 2), side / 2 + 20);
    }
  }
}

TEST(LayoutIndex, UpdatedTilesAreSearchedAsBuiltOnesAre) {
  std::vector<LayoutObject> map = CarParks(20, 7);
  LayoutIndex kept(map, 50, 2);
  ASSERT_NE(kept.tiles(), nullptr);
  const auto before = PosesIn(kept);
  EXPECT_GT(before.size(), 50u);
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<LayoutObject> changed;
    std::vector<int> removed;
    for (int i = 0; i < 10; ++i) {  // moved
      LayoutObject& object = map[random() % map.size()];
      if (ChangingMap::Holds(changed, object.id)) continue;
      object.position += Vec3(3. * (random() % 100) - 150, 0.1 * (random() % 10), 0);
      changed.push_back(object);
    }
    for (int i = 0; i < 5; ++i) {  // come
      map.push_back(ObjectAt({1. * (random() % 400), 1. * (random() % 300), 0}));
      map.back().id = 100000 + 5 * round + i;
      changed.push_back(map.back());
    }
    for (int i = 0; i < 5; ++i) {  // go
      const auto at = map.begin() + static_cast<std::ptrdiff_t>(random() % map.size());
      if (ChangingMap::Holds(changed, at->id)) continue;
      removed.push_back(at->id);
      map.erase(at);
    }
    kept.Update(changed, removed);
  }
  const auto after = PosesIn(kept);
  EXPECT_NE(after, before);
  EXPECT_EQ(after, PosesIn(LayoutIndex(map, 50, 2)));
}

TEST(LayoutIndex, UpdatesOfAllAndOfNothing) {
  std::vector<LayoutObject> map = Strewn(2500, 570, 4);
  for (std::size_t i = 0; i < map.size(); ++i) map[i].id = static_cast<int>(i);
  LayoutIndex index({}, 50, 2);
  index.Update({}, {});
  EXPECT_TRUE(index.objects().empty());
  index.Update(map, {});
  EXPECT_NE(index.triangles(), nullptr);
  ExpectSameAnswers(index, LayoutIndex(map, 50, 2), 300);
  std::vector<int> all;
  for (const LayoutObject& object : map) all.push_back(object.id);
  index.Update({}, all);
  EXPECT_TRUE(index.objects().empty());
  EXPECT_EQ(index.triangles(), nullptr) << "small again";
  EXPECT_TRUE(index.FindWithinReach(0, 0).empty());
}

TEST(LayoutIndex, TakesOddMaps) {
  EXPECT_TRUE(LayoutIndex({}, 50, 2).FindWithinReach(0, 0).empty());
  const std::vector<LayoutObject> odd = {ObjectAt({NAN, 0, 0}), ObjectAt({0, INFINITY, 0}),
                                         ObjectAt({1, 1, 1})};
  const LayoutIndex index(odd, 50, 2);
  EXPECT_EQ(index.objects().size(), 1u);
  EXPECT_EQ(*index.FindWithinReach(1, 1).begin(), 0);
  // no memory for what lies between
  const LayoutIndex far({ObjectAt({0, 0, 0}), ObjectAt({1e7, -1e7, 0})}, 50, 2);
  EXPECT_FALSE(far.FindWithinReach(1e7, -1e7).empty());
  const LayoutIndex heap(std::vector<LayoutObject>(20, ObjectAt({3, 3, 3})), 50, 2);
  EXPECT_TRUE(heap.pairs().Between(0, 0, 0, 50).empty());
}

}  // namespace
}  // namespace sslcd
