// SPDX-License-Identifier: BSD-3-Clause
#include "loop/raster_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loop/layout_index.h"
#include "row_cases.h"

namespace sslcd {
namespace {

// Whether a pose maps the centre to nearly its place, with nearly its heading.
bool IsNear(const CoarsePose& pose, const YawShift& truth, const Vec3& centre) {
  const Vec3 place = Apply(truth, centre);
  return std::hypot(pose.x - place.x(), pose.y - place.y()) < 2 &&
         std::abs(WrapAngle(std::atan2(pose.sine, pose.cosine) - truth.yaw)) < 0.08;
}

TEST(SearchRasters, TheTruePoseIsAmongThePeaksOfACity) {
  const std::vector<LayoutObject> map = CarParks(80, 5);
  ASSERT_GT(map.size(), 10000u);
  const LayoutIndex index(map, 50, 2);
  int found = 0;
  for (unsigned query = 0; query < 20; ++query) {
    const YawShift truth{0.3 * query - 3, {20, -10. * query, 0.3}};
    const Vec2 place(105. * (query % 9) + 5, 75. * (query % 8) - 6);
    const std::vector<LayoutObject> local =
        WithMisses(SeenFrom(map, truth, place, 14, 0.5, query), 5);
    Vec3 centre;
    const RasterPoses peaks = SearchRasters(CentredPoints(local, centre), index, 1000);
    EXPECT_GT(peaks.poses.size(), 100u);
    EXPECT_LE(peaks.poses.size(), 1000u);
    for (const CoarsePose& pose : peaks.poses) EXPECT_GT(pose.score, peaks.cut_off);
    found += std::any_of(peaks.poses.begin(), peaks.poses.end(),
                         [&](const CoarsePose& pose) { return IsNear(pose, truth, centre); });
  }
  EXPECT_EQ(found, 20);
}

TEST(SearchRasters, KnowsWhereItHasSearched) {
  int rows = 0, strewn = 0;  // of 15 places each
  for (const unsigned seed : {1, 2, 3}) {
    std::vector<LayoutObject> map = CarParks(20, seed);
    for (LayoutObject object : Strewn(400, 200, seed)) {
      object.position.x() -= 2000;
      map.push_back(object);
    }
    const LayoutIndex index(map, 50, 2);
    ASSERT_NE(index.tiles(), nullptr);
    Vec3 centre;
    const std::vector<LayoutObject> local = SeenFrom(map, {1, {0, 0, 0}}, {5, 5}, 14, 0.2, seed);
    const RasterPoses peaks = SearchRasters(CentredPoints(local, centre), index, 500);
    CoarsePose pose;
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 3; ++j) {
        pose.y = 30.f * static_cast<float>(j);
        pose.x = 105.f * static_cast<float>(i);
        rows += peaks.HasSearched(*index.tiles(), pose);
        pose.x = -2080 + 40.f * static_cast<float>(i);
        strewn += peaks.HasSearched(*index.tiles(), pose);
      }
    pose.x = 1e6;
    EXPECT_FALSE(peaks.HasSearched(*index.tiles(), pose));
  }
  EXPECT_GE(rows, 3 * 14);
  EXPECT_LT(strewn, rows - 4);
}

TEST(SearchRasters, OddLayouts) {
  const LayoutIndex index(CarParks(20, 1), 50, 2);
  EXPECT_TRUE(SearchRasters({}, index, 100).poses.empty());
  EXPECT_TRUE(SearchRasters({{0, 0, 0, 0}}, index, 100).poses.empty()) << "one has no direction";
  EXPECT_TRUE(SearchRasters({{0, 0, 0, 77}, {5, 0, 0, 77}}, index, 100).poses.empty())
      << "no such label";
  EXPECT_TRUE(SearchRasters({{-900, 0, 0, 0}, {900, 0, 0, 0}}, index, 100).poses.empty())
      << "too far apart";
  const std::vector<LayoutPoint> heap(30, LayoutPoint{0, 0, 0, 0});
  EXPECT_TRUE(SearchRasters(heap, index, 100).poses.empty()) << "equal points have no direction";
}

TEST(SearchRasters, EqualObjectsOnAPerfectGridEndWithFewPoses) {
  std::vector<LayoutObject> grid;
  for (int i = 0; i < 10000; ++i) grid.push_back(ObjectAt({2.5 * (i % 100), 6. * (i / 100), 0}));
  const LayoutIndex index(grid, 50, 2);
  std::vector<LayoutPoint> local;
  for (int i = 0; i < 20; ++i)
    local.push_back(
        {2.5f * static_cast<float>(i % 5) - 5, 6.f * static_cast<float>(i / 5) - 9, 0, 0});
  EXPECT_LE(SearchRasters(local, index, 1000).poses.size(), 1000u);
}

TEST(SearchRasters, ManyObjectsAtOnePoint) {
  std::vector<LayoutObject> map = CarParks(20, 1);
  map.insert(map.end(), 2000, ObjectAt({7, 7, 0}));
  const LayoutIndex index(map, 50, 2);
  ASSERT_NE(index.tiles(), nullptr);
  std::vector<LayoutPoint> local;
  for (int i = 0; i < 10; ++i) local.push_back({3.f * static_cast<float>(i % 5), 0, 0, 0});
  EXPECT_LE(SearchRasters(local, index, 500).poses.size(), 500u);
}

// The time grows with the tiles that have objects, not with the area of the map.
TEST(SearchRasters, FewRowsInAHugeArea) {
  const std::vector<LayoutObject> park = CarPark({5, 5}, 0.3, 1);
  std::vector<LayoutObject> map;
  for (int i = 0; i < 30; ++i)
    for (LayoutObject object : park) {
      object.position.x() += 1e5 * i;
      map.push_back(object);
    }
  const LayoutIndex index(map, 50, 2);
  ASSERT_NE(index.tiles(), nullptr);
  EXPECT_LT(index.tiles()->tile_count(), 200u);
  Vec3 centre;
  const YawShift truth{1, {1e5, 0, 0}};
  const std::vector<LayoutObject> local = SeenFrom(map, truth, {1e5 + 5, 5}, 14, 0.2, 1);
  const RasterPoses found = SearchRasters(CentredPoints(local, centre), index, 500);
  EXPECT_TRUE(std::any_of(found.poses.begin(), found.poses.end(),
                          [&](const CoarsePose& pose) { return IsNear(pose, truth, centre); }));
}

}  // namespace
}  // namespace sslcd
