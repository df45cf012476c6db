// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refine_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace sslcd {
namespace {

constexpr int kFrames = 100;
constexpr double kStep = 0.2;    // metres a frame
constexpr double kPeriod = 0.1;  // seconds a frame

// A camera drives 20 m straight ahead between trees that it always sees. Sightings have no error.
// World axes are the first camera's (y down).
class RefineMapTest : public ::testing::Test {
 protected:
  RefineMapTest() {
    for (int i = 0; i < kFrames; ++i) {
      FrameRecord record;
      record.frame = 10 * i;  // numbers are not indices
      record.stamp = kPeriod * i;
      record.T_odom_cam = record.T_world_cam = Pose::Trans(0, 0, kStep * i);
      records_.push_back(record);
    }
  }

  LandmarkId Add(const Vec3& position, const std::string& label = "Tree",
                 LandmarkState state = LandmarkState::kConfirmed) {
    MapLandmark landmark;
    landmark.label = label;
    landmark.symmetry = label == "Tree" ? Symmetry::kFull : Symmetry::kNone;
    landmark.state = state;
    landmark.pose = {position, 0};
    return map_.Insert(landmark);
  }
  // The frame sees an object there and takes it for a landmark (-1: for none).
  void See(LandmarkId id, const std::string& label, int i, const Vec3& position) {
    FrameRecord& record = records_[i];
    Detection detection;
    detection.label = label;
    detection.T_cam_object = record.T_world_cam.inverse() * ToPose({position, 0}, map_.gravity());
    detection.dims = label == "Tree" ? Vec3(0.5, 0.5, 3) : Vec3(4, 1.8, 1.5);
    record.detections.push_back(detection);
    record.matched.push_back(id);
    if (id.value >= 0)
      sightings_[id.value].push_back(
          {record.frame, record.stamp, 0, 1., detection.T_cam_object, detection.dims});
  }
  // Every `every`-th frame from `first` to before `end` sees the landmark at a place.
  void See(LandmarkId id, int first, int end, const Vec3& position, int every = 1) {
    for (int i = first; i < end; i += every) See(id, map_.at(id).label, i, position);
  }
  LandmarkId AddSeen(const Vec3& position, int first, int end, const std::string& label = "Tree",
                     LandmarkState state = LandmarkState::kConfirmed) {
    const LandmarkId id = Add(position, label, state);
    See(id, first, end, position);
    return id;
  }
  // Its motion test has these positions, half a second apart.
  LandmarkId AddTentative(const std::string& label, const std::vector<Vec2>& positions) {
    MapLandmark landmark;
    landmark.label = label;
    landmark.symmetry = label == "Tree" ? Symmetry::kFull : Symmetry::kNone;
    landmark.pose.position = {3, 1, 30};
    for (std::size_t i = 0; i < positions.size(); ++i)
      landmark.motion.Add(positions[i], 0.04 * MotionTest::Covariance::Identity(), 0.5 * i,
                          options_.map.motion);
    return map_.Insert(landmark);
  }
  void AddTrees(int every = 1) {
    for (const double z : {24., 29., 34.})
      for (const double x : {-8., -6., 6., 8.})
        See(Add({x, 1, z + x / 4}), 0, kFrames, {x, 1, z + x / 4}, every);
  }

  BaSummary Refine(int rounds) {
    for (FrameRecord& record : records_) state_.frames.Append(std::move(record));
    for (auto& [id, sightings] : sightings_) map_.SetSightings({id}, std::move(sightings));
    options_.refine.rounds = rounds;
    return RefineMap(state_, log_scale_, {}, options_, nullptr);
  }

  LandmarkState StateOf(LandmarkId id) const { return map_.at(id).state; }
  bool IsGone(LandmarkId id) const { return map_.landmarks().count(id.value) == 0; }
  double ErrorOfFrame(int i) const {
    return (state_.frames[i].T_world_cam.inverse() * Pose::Trans(0, 0, kStep * i)).Log().norm();
  }

  MapState state_{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), {}};
  ObjectMap& map_ = state_.map;
  WholeMapOptions options_;
  double log_scale_ = 0;
  std::vector<FrameRecord> records_;
  std::map<int, std::vector<Sighting>> sightings_;
};

constexpr LandmarkState kTentative = LandmarkState::kTentative, kStale = LandmarkState::kStale,
                        kConfirmed = LandmarkState::kConfirmed, kDynamic = LandmarkState::kDynamic;

TEST_F(RefineMapTest, ConfirmsWhatWasSeenOftenEnough) {
  AddTrees();
  const Vec3 place(3, 1, 30);
  const LandmarkId twice = AddSeen(place, 0, 2, "Tree", kTentative),
                   once = AddSeen(place, 2, 3, "Tree", kTentative),
                   stale = AddSeen(place, 3, 5, "Tree", kStale),
                   confirmed_once = AddSeen(place, 5, 6, "Tree", kConfirmed),
                   driving = AddSeen(place, 6, 40, "Tree", kDynamic);
  Refine(0);
  EXPECT_EQ(StateOf(twice), kConfirmed);
  EXPECT_EQ(StateOf(once), kTentative);
  EXPECT_EQ(StateOf(stale), kConfirmed);
  EXPECT_EQ(StateOf(confirmed_once), kStale);
  EXPECT_EQ(StateOf(driving), kDynamic);
}

TEST_F(RefineMapTest, ConfirmsMovableObjectsOnlyWhereTheyAreParked) {
  AddTrees();
  const std::vector<Vec2> one{{0, 0}}, still(7, Vec2(0, 0)),
      ahead{{0, 0}, {5, 0}, {10, 0}, {15, 0}, {20, 0}, {25, 0}};
  const LandmarkId unknown = AddTentative("Car", one), parked = AddTentative("Car", still),
                   driving = AddTentative("Car", ahead), tree = AddTentative("Tree", ahead);
  for (const LandmarkId id : {unknown, parked, driving, tree}) See(id, 0, 10, {3, 1, 30});
  ASSERT_EQ(map_.at(unknown).motion.Verdict(options_.map.motion), Motion::kUndecided);
  ASSERT_EQ(map_.at(driving).motion.Verdict(options_.map.motion), Motion::kDriving);
  Refine(0);
  EXPECT_EQ(StateOf(unknown), kTentative);
  EXPECT_EQ(StateOf(parked), kConfirmed);
  EXPECT_EQ(StateOf(driving), kTentative);
  EXPECT_EQ(StateOf(tree), kConfirmed) << "trees do not move";
}

// The stream removes tentative objects that are out of sight from the search index.
TEST_F(RefineMapTest, WhatItConfirmsIsFoundByAssociation) {
  AddTrees();
  const Vec3 place(3, 1, 30);
  const LandmarkId tree = AddSeen(place, 0, 2, "Tree", kTentative);
  map_.AddFrame(-1, 100., Pose(), {}, nullptr);
  ASSERT_EQ(StateOf(tree), kStale);
  See({}, "Tree", 50, place);
  Refine(1);
  EXPECT_EQ(map_.at(tree).sightings.size(), 3u);
}

TEST_F(RefineMapTest, AdjustsCamerasAndObjects) {
  AddTrees();
  const LandmarkId tree = AddSeen({3, 1, 30}, 0, 30);
  map_.SetPose(tree, {Vec3(3.4, 1, 30.5), 0});
  for (int i = 0; i < kFrames; ++i)
    records_[i].T_world_cam = Pose::Trans(0.005 * i, 0, -0.003 * i) * records_[i].T_world_cam;
  EXPECT_TRUE(Refine(0).usable);
  for (int i = 0; i < kFrames; ++i) EXPECT_LT(ErrorOfFrame(i), 1e-3) << i;
  EXPECT_LT((map_.at(tree).pose.position - Vec3(3, 1, 30)).norm(), 1e-3);
}

// Odometry is a tenth too short; the objects reveal it.
TEST_F(RefineMapTest, FindsTheScaleOfOdometry) {
  AddTrees();
  for (FrameRecord& record : records_) {
    record.T_odom_cam.translation() *= 0.9;
    record.T_world_cam = record.T_odom_cam;
  }
  EXPECT_TRUE(Refine(0).usable);
  EXPECT_NEAR(std::exp(log_scale_), 1 / 0.9, 0.01);
  EXPECT_LT(ErrorOfFrame(kFrames - 1), 0.1);
}

TEST_F(RefineMapTest, AssociatesAllDetectionsAgain) {
  AddTrees();
  const Vec3 place(3, 1, 30);
  const LandmarkId tree = AddSeen(place, 0, 10), other = AddSeen({-3, 1, 30}, 0, 10);
  See({}, "Tree", 10, place);     // was not matched
  See(other, "Tree", 11, place);  // was matched with another one
  const LandmarkId mixed = AddSeen({-3, 1, 36}, 12, 13);
  See(mixed, "Tree", 13, place);
  Refine(1);
  EXPECT_EQ(state_.frames[10].matched.back(), tree);
  EXPECT_EQ(state_.frames[11].matched.back(), tree);
  EXPECT_EQ(map_.at(tree).sightings.size(), 13u);
  EXPECT_EQ(map_.at(other).sightings.size(), 10u);
  EXPECT_LT((map_.at(other).pose.position - Vec3(-3, 1, 30)).norm(), 1e-4)
      << "optimised with the new association";
  EXPECT_EQ(StateOf(mixed), kStale) << "one sighting is left";
}

// Segments of the path, between which the drift is unknown until an object links them.
TEST_F(RefineMapTest, AssociatesNothingAcrossUnlinkedSegmentsOfThePath) {
  options_.map.memory_m = 2;
  const LandmarkId tree = AddSeen({3, 1, 30}, 0, 10);
  See({}, "Tree", 15, {3, 1, 30});  // in the next segment
  See({}, "Tree", 65, {3, 1, 30});
  Refine(1);
  EXPECT_EQ(state_.frames[15].matched.back(), tree);
  EXPECT_EQ(state_.frames[65].matched.back().value, -1);
}

TEST_F(RefineMapTest, AssociatesAcrossLinkedSegments) {
  options_.map.memory_m = 2;
  const LandmarkId tree = AddSeen({3, 1, 30}, 0, 10);
  See({}, "Tree", 65, {3, 1, 30});
  AddTrees();  // seen everywhere
  Refine(1);
  EXPECT_EQ(state_.frames[65].matched.front(), tree);
}

TEST_F(RefineMapTest, WithoutRoundsItOnlyOptimises) {
  AddTrees();
  const LandmarkId one = AddSeen({3, 1, 30}, 0, 10), two = AddSeen({3, 1, 30}, 10, 20);
  See({}, "Tree", 20, {3, 1, 30});
  EXPECT_TRUE(Refine(0).usable);
  EXPECT_FALSE(IsGone(one) || IsGone(two));
  EXPECT_EQ(state_.frames[20].matched.back().value, -1);
}

TEST_F(RefineMapTest, DrivingObjectsKeepTheirDetections) {
  AddTrees();
  const Vec3 place(3, 1, 30);
  const LandmarkId parked = AddSeen(place, 0, 20, "Car"),
                   driving = AddSeen(place, 20, 30, "Car", kDynamic);
  Refine(1);
  EXPECT_EQ(map_.at(parked).sightings.size(), 20u);
  EXPECT_EQ(map_.at(driving).sightings.size(), 10u);
  EXPECT_EQ(state_.frames[25].matched.back(), driving);
}

// So close to each other that the detector's errors explain it.
TEST_F(RefineMapTest, FusesDuplicates) {
  AddTrees();
  const Vec3 here(3, 1, 30), there(3, 1, 30.6);
  const LandmarkId one = Add(here), two = Add(there);
  See(one, 0, 20, here, 2);
  See(two, 1, 20, there, 2);
  Refine(1);
  ASSERT_NE(IsGone(one), IsGone(two));
  EXPECT_EQ(map_.at(IsGone(one) ? two : one).sightings.size(), 20u);
}

TEST_F(RefineMapTest, RejectsWhatMoved) {
  AddTrees();
  const auto add = [&](const std::string& label, double metres, int frames) {
    const Vec3 from(3, 1, 30);
    const LandmarkId id = Add(from, label);
    for (int i = 0; i < frames; ++i)
      See(id, label, i, from + Vec3(0, 0, i < frames / 2 ? 0 : metres));
    return id;
  };
  const LandmarkId far = add("Car", 3, 30), near = add("Car", 1.2, 12),
                   slow = add("Car", 3, kFrames), tree = add("Tree", 3, 30);
  const LandmarkId steady = Add({-3, 1, 30}, "Car");  // its first and last thirds are 1.7 m apart
  for (int i = 0; i < 20; ++i) See(steady, "Car", i, Vec3(-3, 1, 30 + 2.6 * i / 19));
  Refine(1);
  EXPECT_EQ(StateOf(far), kDynamic);
  EXPECT_NE(StateOf(near), kDynamic);
  EXPECT_NE(StateOf(slow), kDynamic) << "0.3 m/s";
  EXPECT_NE(StateOf(tree), kDynamic);
  EXPECT_EQ(StateOf(steady), kDynamic);
}

// Several passing objects at one place are seen in few of the frames.
TEST_F(RefineMapTest, RejectsMovableObjectsThatAreSeldomSeen) {
  AddTrees();
  const auto add = [&](const std::string& label, double x, int every) {
    const LandmarkId id = Add({x, 1, 30}, label);
    See(id, 0, 40, {x, 1, 30}, every);
    return id;
  };
  const LandmarkId seldom = add("Car", 3, 3), often = add("Car", -3, 2), tree = add("Tree", 0, 3);
  const LandmarkId gap = AddSeen({3, 1, 40}, 0, 2, "Car");  // out of sight for more than 2 s
  See(gap, 30, 32, {3, 1, 40});
  const LandmarkId open = AddTentative("Car", {{0, 0}});
  See(open, 0, 40, {-3, 1, 40}, 3);
  Refine(1);
  EXPECT_EQ(StateOf(seldom), kDynamic);
  EXPECT_EQ(StateOf(often), kConfirmed);
  EXPECT_EQ(StateOf(tree), kConfirmed);
  EXPECT_EQ(StateOf(gap), kConfirmed);
  EXPECT_EQ(StateOf(open), kTentative) << "it is not part of the map anyway";
}

// It was in sight in four frames, and seen in all of them.
TEST_F(RefineMapTest, AGapOutOfSightCountsAsTheSightingAfterIt) {
  options_.refine.min_seen_share = 0.9;
  AddTrees();
  const LandmarkId car = AddSeen({3, 1, 30}, 0, 2, "Car");
  See(car, 30, 32, {3, 1, 30});
  Refine(1);
  EXPECT_EQ(StateOf(car), kConfirmed);
}

TEST_F(RefineMapTest, FramesWithoutADetectionDoNotCount) {
  AddTrees(3);  // the detector runs in every third frame
  const LandmarkId car = Add({3, 1, 30}, "Car");
  See(car, 0, 40, {3, 1, 30}, 3);
  Refine(1);
  EXPECT_EQ(StateOf(car), kConfirmed);
}

TEST_F(RefineMapTest, NothingToRefine) {
  records_.clear();
  EXPECT_FALSE(Refine(2).usable);
  EXPECT_EQ(log_scale_, 0);
}

}  // namespace
}  // namespace sslcd
