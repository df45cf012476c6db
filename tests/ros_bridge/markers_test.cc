// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/markers.h"

#include <gtest/gtest.h>

#include <set>

namespace sslcd::ros_bridge {
namespace {

TEST(ObjectMarkers, AreConfirmedObjectsOnly) {
  std::vector<MapObject> objects(3);
  for (int i = 0; i < 3; ++i) objects[i].id = {i};
  objects[1].state = LandmarkState::kConfirmed;
  objects[1].label = "Car";
  objects[1].dims = Vec3(4, 2, 1.5);
  objects[1].T_world_object = Pose::Trans(1, 2, 3);
  objects[2].state = LandmarkState::kDynamic;
  const std::vector<Marker> markers = ObjectMarkers(objects);
  ASSERT_EQ(markers.size(), 1u);
  EXPECT_EQ(markers[0].id, 1);
  EXPECT_EQ(markers[0].name_space, "Car");
  EXPECT_EQ(markers[0].scale, Vec3(4, 2, 1.5));
  EXPECT_EQ(markers[0].pose.translation(), Vec3(1, 2, 3));
  EXPECT_GT(markers[0].colour[3], 0);
  EXPECT_TRUE(ObjectMarkers({}).empty());
}

TEST(LoopMarker, JoinsPosesOfThePath) {
  // time was set back: two frames have one stamp
  const std::vector<PathPose> path{
      {0, 10, Pose::Trans(1, 0, 0)}, {1, 11, Pose::Trans(2, 0, 0)}, {2, 10, Pose::Trans(3, 0, 0)}};
  LoopEdge loop;
  loop.match_frame = 0;
  loop.query_frame = 2;
  LoopEdge unknown;
  unknown.match_frame = 0;
  unknown.query_frame = 7;
  const Marker marker = LoopMarker(path, {{1, loop}, {2, unknown}});
  ASSERT_EQ(marker.points.size(), 2u);
  EXPECT_EQ(marker.points[0].x(), 1);
  EXPECT_EQ(marker.points[1].x(), 3);
  EXPECT_TRUE(LoopMarker({}, {}).points.empty());
}

TEST(Drops, EachReasonHasItsWords) {
  std::set<std::string> words;
  for (int i = 0; i < static_cast<int>(Drop::kCount); ++i) {
    Drops drops;
    EXPECT_EQ(drops.Text(), "");
    drops.Count(static_cast<Drop>(i), 3);
    EXPECT_EQ(drops[static_cast<Drop>(i)], 3);
    EXPECT_EQ(drops.defects(), static_cast<Drop>(i) == Drop::kDetectionsTooSoon ? 0 : 3);
    words.insert(drops.Text());
  }
  EXPECT_EQ(words.size(), static_cast<std::size_t>(Drop::kCount));
  Drops both;
  both.Count(Drop::kObject);
  both.Count(Drop::kOdometryDuplicate, 2);
  EXPECT_EQ(both.Text(),
            "2 odometry: duplicate stamp; 1 objects: unusable pose, size, label or score");
}

}  // namespace
}  // namespace sslcd::ros_bridge
