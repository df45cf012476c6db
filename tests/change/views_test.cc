// SPDX-License-Identifier: BSD-3-Clause
#include "change/views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

constexpr double kSight = 20;  // of the detector, 45 degrees to both sides [m]

struct Post {
  double x = 0, z = 0;  // to the right of the path, and along it [m]
  double up = 0;
  std::vector<int> sessions{0, 1};  // in which it stands
  Vec3 dims{0.4, 0.4, 2};
};

struct Drive {
  double up = 0;
  int map = 0;
  std::vector<Detection> passing;  // in the camera, in each frame
};

// Posts along 60 m of path, every 3 m on both sides, and what else there is: these first.
std::vector<std::vector<Views>> Collect(std::vector<Post> posts, const std::vector<Drive>& drives) {
  for (int i = 0; i < 20; ++i)
    for (const double x : {-6., 6.}) posts.push_back({x, 9 + 3. * i});
  HistoryWorld world;
  world.sessions = static_cast<int>(drives.size());
  std::vector<Vec3> places;
  for (const Post& post : posts) {
    MapObject object;
    object.id.value = static_cast<int>(places.size()) + 1;
    object.label = "Pole";
    object.state = LandmarkState::kConfirmed;
    object.dims = post.dims;
    places.push_back(Vec3(post.x, -post.up, post.z));
    object.T_world_object = Pose(world.gravity.Upright(0), places.back());
    world.objects.push_back(object);
  }
  std::vector<HistoryFrame> frames;
  for (int s = 0; s < world.sessions; ++s)
    for (int z = 0; z < 60; ++z) {
      HistoryFrame frame;
      frame.number = static_cast<int>(frames.size());
      frame.session = s;
      frame.map = drives[s].map;
      frame.T_world_cam = Pose::Trans(0, -drives[s].up, z);
      frame.detections = drives[s].passing;
      for (std::size_t i = 0; i < posts.size() && frame.map == 0; ++i) {
        const std::vector<int>& there = posts[i].sessions;
        const Vec3 p = frame.T_world_cam.inverse() * places[i];
        if (p.norm() > kSight || p.z() < std::abs(p.x()) || std::abs(p.y()) > 1 ||
            std::count(there.begin(), there.end(), s) == 0)
          continue;
        Detection detection;
        detection.row = static_cast<int>(i);
        detection.dims = posts[i].dims;
        detection.T_cam_object = frame.T_world_cam.inverse() * world.objects[i].T_world_object;
        frame.detections.push_back(detection);
        world.objects[i].observations.push_back({frame.number, detection.row});
      }
      frames.push_back(frame);
    }
  Sightings sightings(world);
  for (const HistoryFrame& frame : frames) sightings.AddFrame(frame);
  const std::vector<Place> found = FindPlaces(sightings);
  EXPECT_EQ(found.size(), posts.size());
  return CollectViews(sightings, found);
}

int CountSeen(const Views& views) {
  return static_cast<int>(
      std::count_if(views.begin(), views.end(), [](const View& view) { return view.seen; }));
}

double MeanVisible(const Views& views) {
  double sum = 0;
  for (const View& view : views) sum += view.visible;
  return sum / static_cast<double>(views.size());
}

TEST(Views, WhatIsNoLongerThereIsViewedWhereTheDetectorSees) {
  const auto views = Collect({{2, 40, 0, {0}}}, {{}, {}});
  const Views &seen = views[0][0], &missed = views[0][1];
  ASSERT_GT(seen.size(), 10u);
  EXPECT_EQ(CountSeen(seen), static_cast<int>(seen.size()));
  EXPECT_EQ(CountSeen(missed), 0);
  EXPECT_NEAR(static_cast<double>(missed.size()), static_cast<double>(seen.size()), 1);
  for (const View& view : missed) {
    EXPECT_LE(view.range_m, kSight);
    EXPECT_LT(std::abs(view.bearing_rad), (45 + 5) * M_PI / 180);
  }
}

TEST(Views, OtherStoreysAreNotViewed) {
  Drive upper;
  upper.up = 3;
  const auto views = Collect({{3, 40, 3, {2}}, {-3, 40, 0, {0}}}, {{}, {}, upper});
  EXPECT_TRUE(views[0][0].empty());
  EXPECT_TRUE(views[0][1].empty());
  EXPECT_GT(CountSeen(views[0][2]), 10);
  EXPECT_GT(views[1][1].size(), 10u) << "of the lower storey";
  EXPECT_TRUE(views[1][2].empty());
}

TEST(Views, AnotherMapHasNone) {
  Drive elsewhere;
  elsewhere.map = 1;
  for (const std::vector<Views>& place : Collect({}, {{}, {}, elsewhere})) {
    EXPECT_GT(place[0].size() + place[1].size(), 0u);
    EXPECT_TRUE(place[2].empty());
  }
}

TEST(Views, WhatTheSessionHasSeenHidesWhatIsBehind) {
  const Post wall{3, 36, 0, {0}, {6, 0.4, 4}};
  const auto views = Collect({{3, 40}, wall}, {{}, {}});
  EXPECT_LT(MeanVisible(views[0][0]), 0.5);
  EXPECT_GT(MeanVisible(views[0][1]), 0.9) << "the wall has gone";
}

TEST(Views, WhatPassesHides) {
  Detection lorry;
  lorry.row = 1000;
  lorry.dims = Vec3(12, 2, 4);
  lorry.T_cam_object = Pose(GravityFrame().Upright(0), Vec3(0, 0, 2));
  Drive behind;
  behind.passing.push_back(lorry);
  const auto views = Collect({{1, 40}}, {{}, behind});
  EXPECT_GT(MeanVisible(views[0][0]), 0.9);
  EXPECT_LT(MeanVisible(views[0][1]), 0.3);
}

}  // namespace
}  // namespace sslcd
