// SPDX-License-Identifier: BSD-3-Clause
#include "loop/large_map_poses.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "loop/indexed_match.h"
#include "row_cases.h"

namespace sslcd {
namespace {

TEST(LargeMapPoses, ACityOfCarParksLosesNoPlace) {
  const std::vector<LayoutObject> map = CarParks(80, 5);
  const LayoutIndex index(map, 50, 2);
  int right = 0;
  for (unsigned query = 0; query < 12; ++query) {
    const YawShift truth{0.5 * query - 3, {20, -10. * query, 0.3}};
    const Vec2 place(105. * (query % 9) - 12, 75. * (query % 8) + 6);
    const std::vector<LayoutObject> local =
        WithMisses(SeenFrom(map, truth, place, 14, 0.3, query), 6);
    const LayoutAnswer answer = MatchLayouts(local, index);
    ASSERT_FALSE(answer.hypotheses.empty());
    right += answer.decision == LoopDecision::kAccepted &&
             ShiftBetween(answer.hypotheses[0].pose, truth, local[0].position) < 1;
  }
  EXPECT_EQ(right, 12);
}

TEST(LargeMapPoses, RowsAndNoRowsInOneMap) {
  std::vector<LayoutObject> map = CarParks(20, 1);
  for (LayoutObject object : Strewn(1500, 450, 2)) {
    object.position.x() -= 2000;
    map.push_back(object);
  }
  const LayoutIndex index(map, 50, 2);
  const YawShift truth{2, {10, 20, 0}};
  for (const Vec2& place : {Vec2(-2010, 30), Vec2(-1950, -60), Vec2(107, 78)}) {
    const std::vector<LayoutObject> local = SeenFrom(map, truth, place, 22, 0.2, 1);
    const LayoutAnswer answer = MatchLayouts(local, index);
    EXPECT_EQ(answer.decision, LoopDecision::kAccepted) << place.transpose();
    ASSERT_FALSE(answer.hypotheses.empty());
    EXPECT_LT(ShiftBetween(answer.hypotheses[0].pose, truth, local[0].position), 1);
  }
}

TEST(LargeMapPoses, OddLayouts) {
  const LayoutIndex index(CarParks(20, 1), 50, 2);
  EXPECT_TRUE(LargeMapPoses({}, index, {}).best.empty());
  std::vector<LayoutPoint> many;
  for (int i = 0; i < 20000; ++i)
    many.push_back(
        {0.02f * static_cast<float>(i % 1000), 0.9f * static_cast<float>(i / 1000), 0, 0});
  EXPECT_LE(LargeMapPoses(many, index, {}).best.size(), 100u);
}

TEST(LargeMapPoses, AllObjectsAtOnePoint) {
  std::vector<LayoutObject> map = CarParks(20, 1);
  for (LayoutObject& object : map) object.position = Vec3(4, 5, 0);
  map.resize(500);
  for (const LayoutObject& object : CarParks(20, 1)) map.push_back(object);
  const LayoutIndex index(map, 50, 2);
  ASSERT_NE(index.tiles(), nullptr);
  const std::vector<LayoutObject> heap(30, ObjectAt({1, 1, 0}));
  EXPECT_NE(MatchLayouts(heap, index).decision, LoopDecision::kAccepted);
}

}  // namespace
}  // namespace sslcd
