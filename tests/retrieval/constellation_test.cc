// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/constellation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "retrieval/constellation_key.h"
#include "retrieval/neighbours.h"

namespace sslcd {
namespace {

using Five = std::array<SitePoint, kMembers>;

std::optional<Constellation> Make(const Five& five) {
  std::array<const SitePoint*, kMembers> at{};
  for (int i = 0; i < kMembers; ++i) at[i] = &five[i];
  return MakeConstellation(at);
}

const Five kFive = {{{0, 0, 1, 0}, {9, 1, 0, 0}, {3, -1, 0, 0}, {14, 1, 2, 0}, {5, 7, 0, 0}}};

Five Moved(const Five& five, float yaw, float x, float y) {
  Five moved = five;
  for (int i = 0; i < kMembers; ++i) {
    moved[i].x = std::cos(yaw) * five[i].x - std::sin(yaw) * five[i].y + x;
    moved[i].y = std::sin(yaw) * five[i].x + std::cos(yaw) * five[i].y + y;
  }
  return moved;
}

TEST(Constellation, DependsNeitherOnPoseNorOnOrder) {
  const Constellation one = *Make(kFive);
  Five other = Moved(kFive, 2, 30, -7);
  std::reverse(other.begin(), other.end());
  const Constellation two = *Make(other);
  EXPECT_EQ(one.labels, two.labels);
  for (int i = 0; i < kCoordinates; ++i)
    EXPECT_NEAR(one.coordinates[i], two.coordinates[i], 1e-4) << i;
  EXPECT_NEAR(std::cos(2.f) * one.axis_x - std::sin(2.f) * one.axis_y, two.axis_x, 1e-4);
  EXPECT_NEAR(std::sin(2.f) * one.axis_x + std::cos(2.f) * one.axis_y, two.axis_y, 1e-4);
  EXPECT_NEAR(std::cos(2.f) * one.x - std::sin(2.f) * one.y + 30, two.x, 1e-4);
}

TEST(Constellation, MirrorImagesAndLabelsDiffer) {
  Five mirrored = kFive, other = kFive;
  for (SitePoint& point : mirrored) point.y = -point.y;
  other[2].label = 2;
  EXPECT_NE(KeyOf(*Make(kFive)).cell, KeyOf(*Make(mirrored)).cell);
  EXPECT_NE(Make(kFive)->labels, Make(other)->labels);
}

TEST(Constellation, NoneWithoutAnAxis) {
  const Five round = {{{0, 0, 0, 0}, {5, 5, 0, 0}, {-5, 5, 0, 0}, {5, -5, 0, 0}, {-5, -5, 0, 0}}};
  EXPECT_FALSE(Make(round));
  EXPECT_FALSE(Make(Five{}));  // all at one place
  const Five line = {{{0, 0, 0, 0}, {2, 0, 0, 0}, {4, 0, 0, 0}, {6, 0, 0, 0}, {9, 0, 0, 0}}};
  EXPECT_TRUE(Make(line));
}

TEST(Constellation, EachSetIsVisitedOnce) {
  std::vector<SitePoint> points;
  for (int i = 0; i < 6; ++i)
    points.push_back({static_cast<float>(5 * i + i * i), static_cast<float>(i % 2), 0, 0});
  int count = 0;
  VisitConstellations(points, NearestNeighbours(points), [&](const Constellation&) { ++count; });
  EXPECT_EQ(count, 6);  // of 5 out of 6, all of which are neighbours
  points.resize(4);
  VisitConstellations(points, NearestNeighbours(points), [&](const Constellation&) { FAIL(); });
}

TEST(Constellation, NeighboursAreNearestFirst) {
  const std::vector<SitePoint> points = {
      {0, 0, 0, 0}, {5, 0, 0, 0}, {1, 0, 0, 0}, {200, 0, 0, 0}, {0, 3, 0, 0}};
  const std::vector<Neighbours> near = NearestNeighbours(points);
  EXPECT_EQ(near[0][0], 2);
  EXPECT_EQ(near[0][1], 4);
  EXPECT_EQ(near[0][2], 1);
  EXPECT_EQ(near[0][3], -1);  // too far
  EXPECT_EQ(near[3][0], -1);
  EXPECT_TRUE(NearestNeighbours({}).empty());
}

TEST(ConstellationKey, TheProbesHaveTheCellOfANearOne) {
  const SearchedConstellation searched(*Make(kFive));
  std::vector<Probe> probes;
  searched.AppendProbes(4, probes);
  EXPECT_EQ(std::count_if(probes.begin(), probes.end(),
                          [](const Probe& probe) { return probe.cost == 0; }),
            1);
  Five near = kFive;
  near[1].x += 0.25f, near[4].y -= 0.25f;
  const ConstellationKey key = KeyOf(*Make(near));
  const auto probe = std::find_if(probes.begin(), probes.end(),
                                  [&](const Probe& one) { return one.cell == key.cell; });
  ASSERT_NE(probe, probes.end());
  constexpr int kMost = 1000;
  EXPECT_LT(searched.Difference(probe->offsets, key.inside, kMost), 8 * kDifferenceSteps);
  EXPECT_GT(searched.Difference(probe->offsets, ~key.inside, kMost), 8 * kDifferenceSteps);
  const ConstellationKey own = KeyOf(*Make(kFive));
  EXPECT_LT(searched.Difference(0x5555, own.inside, kMost), kDifferenceSteps);
}

// Coordinates by their places in cells, of which the first one begins at zero.
Constellation InCells(const std::array<float, kCoordinates>& at) {
  Constellation one;
  for (int i = 0; i < kCoordinates; ++i)
    one.coordinates[i] = 6 * (std::pow(at[i] / 8 + 1, 2.f) - 1);
  return one;
}

TEST(ConstellationKey, ProbesCrossTheBordersThatAreNear) {
  std::array<float, kCoordinates> middle{};
  for (int i = 0; i < kCoordinates; ++i) middle[i] = static_cast<float>(i) + 0.5f;
  std::vector<Probe> probes;
  SearchedConstellation(InCells(middle)).AppendProbes(4, probes);
  EXPECT_EQ(probes.size(), 1u) << "all borders are too far";
  for (int i = 0; i < kCoordinates; ++i)
    for (const int side : {-1, 1}) {
      std::array<float, kCoordinates> near = middle, across = middle;
      near[i] += 0.4f * static_cast<float>(side);  // a tenth of a cell from the border
      across[i] += 0.6f * static_cast<float>(side);
      probes.clear();
      SearchedConstellation(InCells(near)).AppendProbes(4, probes);
      ASSERT_EQ(probes.size(), 2u) << i;
      EXPECT_EQ(probes[0].offsets, 0x5555);
      EXPECT_EQ(probes[1].offsets, 0x5555 + side * (1 << 2 * i)) << i;
      EXPECT_EQ(probes[1].cell, KeyOf(InCells(across)).cell) << i;
      const float sigmas = 0.1f / 0.22f;
      EXPECT_NEAR(probes[1].cost, sigmas * (0.8f + 0.5f * sigmas), 1e-3);
    }
}

}  // namespace
}  // namespace sslcd
