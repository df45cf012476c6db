// SPDX-License-Identifier: BSD-3-Clause
#include "association/spatial_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sslcd {
namespace {

TEST(SpatialIndex, AgreesWithALinearSearch) {
  std::mt19937 random(3);
  const auto uniform = [&] { return (random() % 20000) / 100. - 100.; };
  SpatialIndex index(7.);
  std::vector<std::pair<double, double>> points;
  for (int id = 0; id < 500; ++id) {
    points.emplace_back(uniform(), uniform());
    index.Put(id, points[id].first, points[id].second);
  }
  for (int id = 0; id < 500; id += 3) {  // some move, some leave
    points[id] = {uniform(), uniform()};
    index.Put(id, points[id].first, points[id].second);
  }
  for (int id = 1; id < 500; id += 5) index.Remove(id);
  for (int trial = 0; trial < 50; ++trial) {
    const double x = uniform(), y = uniform(), radius = 0.5 + trial;
    std::vector<int> expected;
    for (int id = 0; id < 500; ++id)
      if (id % 5 != 1 && std::hypot(points[id].first - x, points[id].second - y) <= radius)
        expected.push_back(id);
    EXPECT_EQ(index.FindWithin(x, y, radius), expected);
  }
}

TEST(SpatialIndex, EmptyUnknownAndRepeated) {
  SpatialIndex index;
  EXPECT_TRUE(index.FindWithin(0, 0, 100).empty());
  index.Remove(5);
  index.Put(5, -0.1, 0.1);
  index.Put(5, -0.1, 0.1);
  EXPECT_EQ(index.size(), 1u);
  EXPECT_EQ(index.FindWithin(0, 0, 1), std::vector<int>{5});
  index.Remove(5);
  index.Remove(5);
  EXPECT_EQ(index.size(), 0u);
}

TEST(SpatialIndex, NowhereAndFarOff) {
  SpatialIndex index;
  index.Put(1, std::nan(""), 0);
  index.Put(2, 1e300, -1e300);
  index.Put(3, 1, 1);
  EXPECT_EQ(index.FindWithin(0, 0, 5), std::vector<int>{3});
  EXPECT_TRUE(index.FindWithin(std::nan(""), 0, 5).empty());
  index.Put(1, 2, 2);
  EXPECT_EQ(index.FindWithin(0, 0, 5), (std::vector<int>{1, 3}));
  EXPECT_EQ(index.FindWithin(0, 0, 1e9), (std::vector<int>{1, 3})) << "and not cell by cell";
  EXPECT_EQ(index.FindWithin(0, 0, HUGE_VAL), (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace sslcd
