// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pair_directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "layout_cases.h"
#include "row_cases.h"

namespace sslcd {
namespace {

using namespace pair_directions;

Counts CountsOf(const std::vector<LayoutPoint>& points) {
  Counts counts{};
  for (const int bin : BinsOf(points)) ++counts[bin];
  return counts;
}

bool Contains(const Headings& headings, double yaw_rad) {
  for (int i = 0; i < headings.count; ++i)
    if (std::abs(WrapAngle(YawOf(headings.bin[i]) - yaw_rad)) < kBinRad) return true;
  return false;
}

TEST(PairDirections, BinsAreThoseOfDistanceAndDirection) {
  EXPECT_EQ(Bin(1.9f, 0), -1);
  EXPECT_EQ(Bin(0, 25.1f), -1);
  EXPECT_EQ(Bin(NAN, 3), -1);
  EXPECT_EQ(Bin(5, 0), 2 * kDirections);
  EXPECT_EQ(Bin(24.9f, 0), 12 * kDirections);
  EXPECT_EQ(Bin(0, 5), 2 * kDirections + kDirections / 2);
  for (float angle = 0; angle < 6.3f; angle += 0.07f) {
    const float dx = 7 * std::cos(angle), dy = 7 * std::sin(angle);
    EXPECT_EQ(Bin(dx, dy), Bin(-dx, -dy)) << angle;
    EXPECT_GE(Bin(dx, dy), 0);
    EXPECT_LT(Bin(dx, dy), kDistances * kDirections);
  }
}

TEST(PairDirections, FindTheHeadingOfRows) {
  for (double yaw = -3; yaw < 3; yaw += 0.37) {
    const Counts map = CountsOf(PointsOf(CarPark({0, 0}, 0.3, 1)));
    const std::vector<LayoutObject> seen =
        SeenFrom(CarPark({0, 0}, 0.3, 1), {yaw, {5, 5, 0}}, {3, 2}, 14, 0.3, 2);
    const Headings headings = FindHeadings(BinsOf(PointsOf(seen)), map);
    EXPECT_TRUE(Contains(headings, yaw)) << yaw;
    EXPECT_TRUE(Contains(headings, yaw + M_PI)) << "a direction has no sign";
  }
}

TEST(PairDirections, BinsOfHeadingsAreInOrder) {
  for (int heading = 0; heading < kHeadings; ++heading)
    EXPECT_NEAR(YawOf(heading), heading * kBinRad, 1e-6);
}

// The sums have 16 bits, which 200 local objects and dense rows exceed.
TEST(PairDirections, CountsOfAnySize) {
  const Counts map = CountsOf(PointsOf(CarPark({0, 0}, 0.3, 1)));
  const std::vector<int> bins =
      BinsOf(PointsOf(SeenFrom(CarPark({0, 0}, 0.3, 1), {0.7, {5, 5, 0}}, {3, 2}, 14, 0.3, 2)));
  const Headings expected = FindHeadings(bins, map);
  ASSERT_GT(expected.count, 0);
  std::vector<int> many;
  for (int i = 0; i < 500; ++i) many.insert(many.end(), bins.begin(), bins.end());
  Counts large = map;
  const int factor = 65535 / *std::max_element(map.begin(), map.end());
  for (std::uint16_t& count : large) count = static_cast<std::uint16_t>(count * factor);
  EXPECT_EQ(FindHeadings(many, map).bin, expected.bin);
  EXPECT_EQ(FindHeadings(bins, large).bin[0], expected.bin[0]);
}

TEST(PairDirections, NoHeadingWithoutCommonRows) {
  const std::vector<int> local = BinsOf(PointsOf(CarPark({0, 0}, 0, 1)));
  EXPECT_EQ(FindHeadings(local, Counts{}).count, 0);
  EXPECT_EQ(FindHeadings({}, CountsOf(PointsOf(CarPark({0, 0}, 0, 1)))).count, 0);
  Counts even;
  even.fill(9);
  EXPECT_EQ(FindHeadings(local, even).count, 0);
  int found = 0;
  for (unsigned seed = 0; seed < 20; ++seed)
    found += FindHeadings(BinsOf(PointsOf(Strewn(15, 50, seed))),
                          CountsOf(PointsOf(Strewn(50, 80, seed + 100))))
                 .count > 0;
  EXPECT_LE(found, 4);
}

}  // namespace
}  // namespace sslcd
