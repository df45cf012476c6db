// SPDX-License-Identifier: BSD-3-Clause
#include "map/object_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// A camera that drives 0.5 m a frame (10 a second) along z and sees cars at given places in the
// world.
class ObjectMapTest : public ::testing::Test {
 protected:
  ObjectMap Make(const MapOptions& options = {}, const AssociationOptions& association = {}) {
    labels.Set("Tree", {Symmetry::kFull});
    return ObjectMap(gravity, labels, {}, association, options);
  }
  Pose Camera(int frame) const { return Pose::Trans(0, 0, 0.5 * frame); }

  Detection See(int frame, const Vec3& place, double yaw = 1.5, const std::string& label = "Car") {
    Detection detection;
    detection.row = next_row++;
    detection.label = label;
    detection.T_cam_object = Camera(frame).inverse() * ToPose({place, yaw}, gravity);
    detection.dims = Vec3(4, 1.7, 1.5);
    return detection;
  }
  static int Count(const ObjectMap& map, LandmarkState state) {
    int count = 0;
    for (const auto& [id, landmark] : map.landmarks()) count += landmark.state == state;
    return count;
  }

  GravityFrame gravity;
  LabelTable labels;
  int next_row = 0;
};

TEST_F(ObjectMapTest, ParkedCarsBecomeTheMap) {
  ObjectMap map = Make();
  for (int frame = 0; frame < 20; ++frame)
    map.AddFrame(frame, 0.1 * frame, Camera(frame),
                 {See(frame, {3, 1, 20}), See(frame, {3, 1, 26}), See(frame, {-3, 1, 20})},
                 nullptr);
  EXPECT_EQ(map.landmarks().size(), 3u);
  EXPECT_EQ(Count(map, LandmarkState::kConfirmed), 3);
  EXPECT_LT((map.at({1}).pose.position - Vec3(3, 1, 20)).norm(), 1e-6);
  EXPECT_EQ(map.at({1}).sightings.size(), 20u);
  EXPECT_NEAR(map.at({1}).pose.yaw, 1.5, 1e-9);
}

TEST_F(ObjectMapTest, HeightAndHeadingAreMeansOverTheSightings) {
  ObjectMap map = Make();
  const double heights[] = {1, 0.9, 1.1, 1.2}, yaws[] = {1.5, 1.6, 1.45 + M_PI, 1.65};
  for (int frame = 0; frame < 4; ++frame)
    map.AddFrame(frame, 0.1 * frame, Camera(frame),
                 {See(frame, {3, heights[frame], 20}, yaws[frame])}, nullptr);
  ASSERT_EQ(map.landmarks().size(), 1u);
  EXPECT_NEAR(map.at({1}).pose.position.y(), 4.2 / 4, 1e-9);
  EXPECT_NEAR(map.at({1}).pose.yaw, 6.2 / 4, 1e-9) << "a reversed heading counts as its opposite";
}

TEST_F(ObjectMapTest, ADrivingCarNeverEntersTheMap) {
  for (const double speed : {3., 8., -15.}) {
    ObjectMap map = Make();
    for (int frame = 0; frame < 30; ++frame) {
      const MapUpdate update = map.AddFrame(
          frame, 0.1 * frame, Camera(frame),
          {See(frame, {3, 1, 20}), See(frame, {0, 1, 40 + 0.1 * speed * frame})}, nullptr);
      ASSERT_EQ(update.matched.size(), 2u);
    }
    EXPECT_EQ(Count(map, LandmarkState::kConfirmed), 1) << "speed " << speed;
    EXPECT_EQ(Count(map, LandmarkState::kDynamic), 1)
        << "speed " << speed << ": one track, not many";
  }
}

TEST_F(ObjectMapTest, ACarThatDrivesOffLeavesTheMap) {
  ObjectMap map = Make();
  for (int frame = 0; frame < 60; ++frame) {
    const double z = 30 + (frame < 30 ? 0 : 0.5 * 2. * std::pow(0.1 * (frame - 30), 2));  // 2 m/s^2
    map.AddFrame(frame, 0.1 * frame, Camera(frame), {See(frame, {0, 1, z})}, nullptr);
    if (frame == 29) {
      EXPECT_EQ(Count(map, LandmarkState::kConfirmed), 1);
    }
  }
  EXPECT_EQ(map.at({1}).state, LandmarkState::kDynamic);
}

TEST_F(ObjectMapTest, ATreeCannotDrive) {
  ObjectMap map = Make();
  for (int frame = 0; frame < 30; ++frame)
    map.AddFrame(frame, 0.1 * frame, Camera(frame),
                 {See(frame, {0, 1, 30 + 0.05 * frame}, 0, "Tree")}, nullptr);
  EXPECT_EQ(Count(map, LandmarkState::kDynamic), 0);
}

TEST_F(ObjectMapTest, SeenOnceGrowsStale) {
  ObjectMap map = Make();
  map.AddFrame(0, 0., Camera(0), {See(0, {3, 1, 20})}, nullptr);
  EXPECT_EQ(Count(map, LandmarkState::kTentative), 1);
  map.AddFrame(1, 10., Camera(1), {}, nullptr);
  EXPECT_EQ(Count(map, LandmarkState::kStale), 1);
  EXPECT_TRUE(map.FindWithin({3, 1, 20}, 5).empty())
      << "given up: nothing is matched with it any more";
}

TEST_F(ObjectMapTest, WeakDetectionsMakeNoLandmarkButFeedOne) {
  ObjectMap map = Make();
  Detection weak = See(0, {3, 1, 20});
  weak.score = 0.2;
  EXPECT_EQ(map.AddFrame(0, 0, Camera(0), {weak}, nullptr).matched[0].value, -1);
  EXPECT_TRUE(map.landmarks().empty());
  map.AddFrame(1, 0.1, Camera(1), {See(1, {3, 1, 20})}, nullptr);
  weak = See(2, {3, 1, 20});
  weak.score = 0.2;
  EXPECT_EQ(map.AddFrame(2, 0.2, Camera(2), {weak}, nullptr).matched[0].value, 1);
}

TEST_F(ObjectMapTest, LearnsHowGoodTheDetectorIs) {
  ObjectMap map = Make();
  const double before = map.noise_scale().radial;
  for (int frame = 0; frame < 200; ++frame) {
    std::vector<Detection> seen;
    for (int k = 0; k < 3; ++k) {
      seen.push_back(See(frame, {3, 1, 120. + 10 * k}));
      Vec3& t = seen.back().T_cam_object.translation();
      // radial error up to 5 %: much more than in the model
      t *= 1 + 0.05 * std::sin(1.7 * frame + k);
    }
    map.AddFrame(frame, 0.1 * frame, Camera(frame), seen, nullptr);
  }
  EXPECT_GT(map.noise_scale().radial, 2 * before);
  EXPECT_LT(map.noise_scale().vertical, before * 2);
}

TEST_F(ObjectMapTest, LandmarksRememberEachCueAndKeepItWhenFused) {
  for (const CueRow& row : kCueRows) {
    SCOPED_TRACE(row.name);
    ObjectMap map = Make();
    std::vector<Detection> seen = {See(0, {3, 1, 20}), See(0, {-30, 1, 20})};
    seen[0].appearance[row.cue] = {1, 0};
    seen[1].appearance[row.cue] = {0, 1};
    map.AddFrame(0, 0, Camera(0), seen, nullptr);
    const auto views = [&map](const CueRow& of) { return map.at({1}).appearance[of.cue].Views(); };
    ASSERT_EQ(views(row).size(), 1u);
    EXPECT_EQ(views(row)[0].vector, (std::vector<float>{1, 0}));
    map.Fuse({1}, {2});
    int sightings = 0;
    for (const AppearanceView& view : views(row)) sightings += view.count;
    EXPECT_EQ(sightings, 2);
    for (const CueRow& other : kCueRows)
      EXPECT_EQ(views(other).empty(), other.cue != row.cue) << other.name;
  }
}

TEST_F(ObjectMapTest, EmptyFramesAndMatchAlone) {
  ObjectMap map = Make();
  EXPECT_TRUE(map.AddFrame(0, 0, Camera(0), {}, nullptr).matched.empty());
  for (int frame = 1; frame < 6; ++frame)
    map.AddFrame(frame, 0.1 * frame, Camera(frame), {See(frame, {3, 1, 20})}, nullptr);
  const auto matched =
      map.Match(0.6, Camera(6), {See(6, {3.1, 1, 20}), See(6, {30, 1, 20})}, nullptr);
  ASSERT_EQ(matched.size(), 2u);
  EXPECT_EQ(matched[0].value, 1);
  EXPECT_EQ(matched[1].value, -1);
  EXPECT_EQ(map.at({1}).sightings.size(), 5u) << "matching changes nothing";
}

}  // namespace
}  // namespace sslcd
