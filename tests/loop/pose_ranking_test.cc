// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_ranking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "loop/layout_index.h"
#include "row_cases.h"

namespace sslcd {
namespace {

struct Scene {
  std::vector<LayoutObject> map = CarParks(20, 1);
  LayoutIndex index{map, 50, 2};
  YawShift truth{0.7, {3, -4, 0.5}};
  Vec3 centre;
  std::vector<LayoutPoint> points =
      CentredPoints(SeenFrom(map, truth, {110, 80}, 14, 0.1, 1), centre);
  PoseSearchOptions options;

  CoarsePose At(double dx, double dy, double turn) const {
    const Vec3 place = Apply(truth, centre);
    CoarsePose pose;
    pose.cosine = static_cast<float>(std::cos(truth.yaw + turn));
    pose.sine = static_cast<float>(std::sin(truth.yaw + turn));
    pose.x = static_cast<float>(place.x() + dx);
    pose.y = static_cast<float>(place.y() + dy);
    return pose;
  }
};

TEST(RankPoses, AlignsAndPutsTheTruthFirst) {
  const Scene scene;
  const std::vector<CoarsePose> ranked = RankPoses({scene.At(2.5, 0, 0), scene.At(0.5, -0.4, 0.03),
                                                    scene.At(0, 8, 0), scene.At(105, 75, M_PI)},
                                                   scene.points, scene.index, scene.options)
                                             .best;
  ASSERT_GE(ranked.size(), 2u);
  const Vec3 place = Apply(scene.truth, scene.centre);
  EXPECT_NEAR(ranked[0].x, place.x(), 0.1);
  EXPECT_NEAR(ranked[0].y, place.y(), 0.1);
  EXPECT_NEAR(ranked[0].z, place.z(), 0.1);
  EXPECT_NEAR(std::atan2(ranked[0].sine, ranked[0].cosine), scene.truth.yaw, 0.01);
  for (std::size_t i = 1; i < ranked.size(); ++i) EXPECT_GE(ranked[i - 1].score, ranked[i].score);
  EXPECT_GT(ranked[0].score, ranked[1].score + 5);
}

TEST(RankPoses, KeepsDistinctOnesUpToTheLimit) {
  Scene scene;
  std::vector<CoarsePose> poses;
  for (int i = 0; i < 60; ++i) poses.push_back(scene.At(2.5 * (i % 12), 8 * (i / 12), 0));
  for (int i = 0; i < 20; ++i) poses.push_back(scene.At(0.02 * i, 0, 0));
  const std::vector<CoarsePose> all =
      RankPoses(poses, scene.points, scene.index, scene.options).best;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(std::hypot(all[i].x - all[j].x, all[i].y - all[j].y), 0.9);
  scene.options.refine = 5;
  EXPECT_EQ(RankPoses(poses, scene.points, scene.index, scene.options).best.size(), 5u);
  EXPECT_TRUE(RankPoses({}, scene.points, scene.index, scene.options).best.empty());
}

TEST(RankPoses, LeavesOutWhatIsLessLikely) {
  Scene scene;
  std::vector<CoarsePose> poses;
  for (int i = 0; i < 60; ++i) poses.push_back(scene.At(2.5 * (i % 12), 8 * (i / 12), 0));
  const CoarseSearch all = RankPoses(poses, scene.points, scene.index, scene.options);
  EXPECT_EQ(all.looked_at, poses.size());
  EXPECT_EQ(all.left_out, -std::numeric_limits<double>::infinity());
  scene.options.refine = 5;
  const CoarseSearch few = RankPoses(poses, scene.points, scene.index, scene.options);
  EXPECT_LT(few.left_out, -3) << "the truth is not left out";
  // a grid of equal objects: as likely as what is kept, and more of them
  std::vector<LayoutObject> grid;
  for (int i = 0; i < 2500; ++i) grid.push_back(ObjectAt({2.5 * (i % 50), 6. * (i / 50), 0}));
  const LayoutIndex index(grid, 50, 2);
  const std::vector<LayoutPoint> points = {{-2.5, 0, 0, 0}, {2.5, 0, 0, 0}, {0, 6, 0, 0}};
  std::vector<CoarsePose> equal(40);
  for (int i = 0; i < 40; ++i) {
    equal[i].x = 2.5f * static_cast<float>(2 + i);
    equal[i].y = 60;
  }
  EXPECT_NEAR(RankPoses(equal, points, index, scene.options).left_out, std::log(35. / 5), 0.2);
}

TEST(RankPoses, FewerUnseenObjectsAreBetter) {
  // The same two matches; at the second pose ten more objects should have been seen.
  std::vector<LayoutObject> map;
  for (const double x : {0., 500.})
    for (const double end : {-10., 10.}) map.push_back(ObjectAt({x + end, 0, 0}));
  for (int i = 1; i <= 10; ++i) map.push_back(ObjectAt({490 + 1.8 * i, 0, 0}, 1));
  const LayoutIndex index(map, 50, 2);
  const std::vector<LayoutPoint> points = {{-10, 0, 0, 0}, {10, 0, 0, 0}};
  CoarsePose full, empty;
  full.x = 500;
  const std::vector<CoarsePose> ranked = RankPoses({full, empty}, points, index, {}).best;
  ASSERT_EQ(ranked.size(), 2u);
  EXPECT_NEAR(ranked[0].x, 0, 1e-3);
  EXPECT_GT(ranked[0].score, ranked[1].score + 1);
}

}  // namespace
}  // namespace sslcd
