// SPDX-License-Identifier: BSD-3-Clause
#include "loop/map_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "row_cases.h"

namespace sslcd {
namespace {

using Content = std::map<std::array<int, 2>,
                         std::pair<std::vector<std::array<float, 4>>, pair_directions::Counts>>;

// Points and counts of the tiles that have points, and of those whose neighbours have any.
Content ContentOf(const MapTiles& map) {
  Content content;
  map.VisitAll([&](const MapTiles::Tile& tile) {
    if (tile.points.empty()) return;
    auto& [points, pairs] = content[{tile.column, tile.row}];
    for (const LayoutPoint& p : tile.points)
      points.push_back({p.x, p.y, p.z, static_cast<float>(p.label)});
    std::sort(points.begin(), points.end());
    pairs = tile.pairs;
  });
  return content;
}

TEST(MapTiles, UpdatesEqualARebuild) {
  std::mt19937 random(3);
  std::vector<LayoutPoint> points = PointsOf(CarParks(9, 1)), now;
  MapTiles kept;
  for (int step = 0; step < 4000; ++step) {
    if (random() % 3 != 0 || now.empty()) {
      now.push_back(points[random() % points.size()]);
      kept.Add(now.back());
    } else {
      std::swap(now[random() % now.size()], now.back());
      kept.Remove(now.back());
      now.pop_back();
    }
  }
  MapTiles fresh;
  for (const LayoutPoint& point : now) fresh.Add(point);
  EXPECT_TRUE(ContentOf(kept) == ContentOf(fresh));
  for (const LayoutPoint& point : now) kept.Remove(point);
  EXPECT_TRUE(ContentOf(kept).empty());
  kept.VisitAll([](const MapTiles::Tile& tile) {
    EXPECT_EQ(std::count(tile.pairs.begin(), tile.pairs.end(), 0),
              static_cast<std::ptrdiff_t>(tile.pairs.size()));
  });
}

TEST(MapTiles, CountsEachPairInTheTilesOfBoth) {
  MapTiles map;
  map.Add({79, 10, 0, 0});
  map.Add({85, 10, 0, 0});
  map.Add({85, 14, 0, 1});
  std::map<double, int> pairs;
  map.VisitAll([&](const MapTiles::Tile& tile) {
    for (const int count : tile.pairs) pairs[tile.left] += count;
  });
  EXPECT_EQ(pairs[0], 2);
  EXPECT_EQ(pairs[80], 4) << "the pair within the tile counts for both objects";
}

TEST(MapTiles, VisitsGroupsOneAfterTheOther) {
  MapTiles map;
  for (const LayoutPoint& point : PointsOf(CarParks(60, 2))) map.Add(point);
  std::vector<std::pair<int, int>> groups;
  map.VisitAll([&](const MapTiles::Tile& tile) {
    const std::pair<int, int> group{tile.row / MapTiles::kGroup, tile.column / MapTiles::kGroup};
    if (groups.empty() || groups.back() != group) groups.push_back(group);
  });
  EXPECT_GT(groups.size(), 3u);
  EXPECT_TRUE(std::is_sorted(groups.begin(), groups.end()));
  EXPECT_EQ(std::adjacent_find(groups.begin(), groups.end()), groups.end());
}

TEST(MapTiles, VisitABox) {
  MapTiles map;
  map.Add({10, 10, 0, 0});
  map.Add({-10, 10, 0, 0});
  map.Add({1e12f, 10, 0, 0});
  const auto count = [&](double left, double right) {
    int tiles = 0;
    map.VisitBox(left, 0, right, 20, [&](const MapTiles::Tile&) { ++tiles; });
    return tiles;
  };
  EXPECT_EQ(count(5, 20), 1);
  EXPECT_EQ(count(-5, 20), 2);
  EXPECT_EQ(count(100, 200), 0);
}

}  // namespace
}  // namespace sslcd
