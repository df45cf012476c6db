// SPDX-License-Identifier: BSD-3-Clause
#include "loop/triangle_poses.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "layout_cases.h"
#include "loop/indexed_match.h"

namespace sslcd {
namespace {

const YawShift kPose{-1.2, {-300, 200, 3}};

// 3000 objects, as dense as kerbs are: more pairs than are listed.
const std::vector<LayoutObject>& LargeMap() {
  static const std::vector<LayoutObject> map = Strewn(3000, 600, 8);
  return map;
}

const LayoutIndex& Index() {
  static const LayoutIndex index(LargeMap(), 50, 2);
  return index;
}

TEST(TrianglePoses, FindTheTruthInALargeMap) {
  ASSERT_NE(Index().triangles(), nullptr);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Vec2 point(-250 + 25. * seed, 200 - 20. * seed);
    std::vector<LayoutObject> local = SeenFrom(LargeMap(), kPose, point, 30, 0.4, seed);
    for (std::size_t i = 0; i < local.size(); i += 4)
      local.erase(local.begin() + static_cast<std::ptrdiff_t>(i));
    ASSERT_GT(local.size(), 10u);
    const LayoutAnswer answer = MatchLayouts(local, Index(), {});
    EXPECT_EQ(answer.decision, LoopDecision::kAccepted) << "seed " << seed;
    ASSERT_FALSE(answer.hypotheses.empty());
    EXPECT_LT(ShiftBetween(answer.hypotheses[0].pose, kPose, local[0].position), 1.)
        << "seed " << seed;
  }
}

TEST(TrianglePoses, MirrorImagesAreNotTaken) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::vector<LayoutObject> local = SeenFrom(LargeMap(), kPose, {0, 40. * seed}, 35, 0.2, seed);
    for (LayoutObject& object : local) object.position.y() *= -1;
    EXPECT_NE(MatchLayouts(local, Index(), {}).decision, LoopDecision::kAccepted)
        << "seed " << seed;
  }
}

TEST(TrianglePoses, ARegularLargeMapIsAmbiguous) {
  std::vector<LayoutObject> grid;
  for (int i = 0; i < 2500; ++i) grid.push_back(ObjectAt({2.5 * (i % 50), 6. * (i / 50), 0}));
  const LayoutIndex index(grid, 50, 2);
  ASSERT_NE(index.triangles(), nullptr);
  std::vector<LayoutObject> local;
  for (int i = 0; i < 20; ++i) local.push_back(ObjectAt({2.5 * (i % 5), 6. * (i / 5), 0}));
  EXPECT_NE(MatchLayouts(local, index, {}).decision, LoopDecision::kAccepted);
}

TEST(TrianglePoses, AreBoundedAndRepeatable) {
  std::vector<LayoutPoint> points;
  for (const LayoutObject& object : SeenFrom(LargeMap(), {}, {0, 0}, 60, 0.3, 1))
    points.push_back({static_cast<float>(object.position.x()),
                      static_cast<float>(object.position.y()),
                      static_cast<float>(object.position.z()), object.label});
  const auto a = TrianglePoses(points, Index()), b = TrianglePoses(points, Index());
  EXPECT_GT(a.size(), 100u);
  EXPECT_LE(a.size(), 3000u);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].x, b[i].x);
    EXPECT_EQ(a[i].sine, b[i].sine);
  }
  std::vector<CoarsePose> kept = a;
  KeepBest(50, kept);
  EXPECT_EQ(kept.size(), 50u);
  float least = 1e9f;
  for (const CoarsePose& pose : kept) least = std::min(least, pose.score);
  EXPECT_LE(std::count_if(a.begin(), a.end(), [&](const auto& pose) { return pose.score > least; }),
            50);
  EXPECT_TRUE(TrianglePoses({}, Index()).empty());
  EXPECT_TRUE(TrianglePoses({points[0], points[1]}, Index()).empty());
}

}  // namespace
}  // namespace sslcd
