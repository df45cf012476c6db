// SPDX-License-Identifier: BSD-3-Clause
#include "map/landmark_store.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

using Ids = std::vector<LandmarkId>;

// Landmarks at places of the horizontal plane, seen in given frames, ten a second.
class LandmarkStoreTest : public ::testing::Test {
 protected:
  LandmarkId Add(const Vec2& place, LandmarkState state, const std::vector<int>& frames) {
    MapLandmark landmark;
    landmark.state = state;
    landmark.pose.position = place.x() * gravity.forward + place.y() * gravity.left;
    for (const int frame : frames) {
      const double stamp = 0.1 * frame;
      landmark.sightings.push_back({frame, stamp, next_row++, 1., Pose(), Vec3(4, 2, 1.5)});
      landmark.motion.Add(place, Eigen::Matrix2d::Identity(), stamp, motion);
      landmark.last_seen = stamp;
    }
    landmark.dims = Vec3(4, 2, 1.5);
    return store.Insert(landmark);
  }

  GravityFrame gravity;
  MotionTestOptions motion;
  LandmarkStore store{gravity, motion};
  int next_row = 0;
};

TEST_F(LandmarkStoreTest, IdsAscendAndAreNotGivenTwice) {
  EXPECT_EQ(Add({0, 0}, LandmarkState::kConfirmed, {0}).value, 1);
  EXPECT_EQ(Add({9, 0}, LandmarkState::kConfirmed, {0}).value, 2);
  store.SetSightings({2}, {});
  EXPECT_EQ(store.all().size(), 1u);
  EXPECT_EQ(Add({9, 0}, LandmarkState::kConfirmed, {0}).value, 3);
}

TEST_F(LandmarkStoreTest, FoundWhereItWasSetTo) {
  const LandmarkId id = Add({3, 20}, LandmarkState::kConfirmed, {0, 1, 2});
  EXPECT_EQ(store.FindWithin({4, 20}, 2), Ids{id});
  const Vec2 parked = store.at(id).motion.PredictParked(0.2, motion).position;
  store.SetPose(id, {Vec3(50, -1, 20), 0.3});
  EXPECT_TRUE(store.FindWithin({4, 20}, 2).empty());
  EXPECT_EQ(store.FindWithin({51, 20}, 2), Ids{id});
  const Vec2 moved = store.at(id).motion.PredictParked(0.2, motion).position - parked;
  EXPECT_NEAR((moved - Vec2(47, 0)).norm(), 0, 1e-9) << "the motion test moves along";
}

TEST_F(LandmarkStoreTest, AFusedOneIsRestoredUnderItsId) {
  const LandmarkId keep = Add({3, 20}, LandmarkState::kConfirmed, {0, 1});
  const LandmarkId drop = Add({4, 20}, LandmarkState::kConfirmed, {5, 6, 7});
  MapLandmark dropped = store.at(drop), kept = store.at(keep);
  store.Fuse(keep, drop);
  const int rewrites = store.rewrites();
  dropped.dims = {};
  store.Restore(dropped);
  EXPECT_NE(store.rewrites(), rewrites);
  EXPECT_EQ(store.at(drop).sightings.size(), 3u);
  EXPECT_EQ(store.at(drop).dims, Vec3(4, 2, 1.5)) << "by its sightings";
  EXPECT_EQ(store.FindWithin({4, 20}, 0.5), Ids{drop});
  kept.state = LandmarkState::kTentative;
  kept.pose.position += 7 * gravity.forward;
  for (int twice = 0; twice < 2; ++twice) store.Restore(kept);
  EXPECT_EQ(store.at(keep).sightings.size(), 2u);
  EXPECT_EQ(store.FindWithin({10, 20}, 0.5), Ids{keep});
  EXPECT_TRUE(store.FindWithin({3, 20}, 0.5).empty()) << "replaced";
  store.Retire(9., 2.);
  EXPECT_EQ(store.at(keep).state, LandmarkState::kStale) << "it can become stale now";
  kept.state = LandmarkState::kConfirmed;
  store.Restore(kept);
  store.Retire(9., 2.);
  EXPECT_EQ(store.FindWithin({10, 20}, 0.5), Ids{keep}) << "and now it cannot";
  EXPECT_EQ(Add({0, 0}, LandmarkState::kConfirmed, {9}).value, 3);
}

TEST_F(LandmarkStoreTest, OpenOnesAreLostWhenUnseenForLong) {
  const LandmarkId parked = Add({0, 0}, LandmarkState::kConfirmed, {0});
  const LandmarkId tentative = Add({1, 0}, LandmarkState::kTentative, {0});
  const LandmarkId dynamic = Add({2, 0}, LandmarkState::kDynamic, {0});
  const LandmarkId recent = Add({3, 0}, LandmarkState::kTentative, {15});
  store.Retire(2., 2.);
  EXPECT_EQ(store.FindWithin({0, 0}, 9), (Ids{parked, tentative, dynamic, recent}));
  store.Retire(3., 2.);
  EXPECT_EQ(store.FindWithin({0, 0}, 9), (Ids{parked, recent}));
  EXPECT_EQ(store.at(tentative).state, LandmarkState::kStale);
  EXPECT_EQ(store.at(dynamic).state, LandmarkState::kDynamic);
  EXPECT_EQ(store.at(recent).state, LandmarkState::kTentative);
  store.SetState(recent, LandmarkState::kConfirmed);
  store.Retire(99., 2.);
  EXPECT_EQ(store.FindWithin({0, 0}, 9), (Ids{parked, recent})) << "confirmed ones stay";
}

TEST_F(LandmarkStoreTest, ADrivingOneIsFoundWhereItIsPredicted) {
  MapLandmark landmark;
  landmark.state = LandmarkState::kDynamic;
  for (int i = 0; i < 20; ++i)
    landmark.motion.Add({i, 0.}, 0.01 * Eigen::Matrix2d::Identity(), 0.1 * i, motion);
  const LandmarkId id = store.Insert(landmark);
  EXPECT_EQ(store.FindWithin({0, 0}, 1), Ids{id});
  store.IndexOpen(2.9);  // at 10 m/s, one second after its last sighting at 19 m
  EXPECT_TRUE(store.FindWithin({0, 0}, 1).empty());
  EXPECT_EQ(store.FindWithin({29, 0}, 2), Ids{id});
}

TEST_F(LandmarkStoreTest, FuseKeepsEverySightingOnce) {
  const LandmarkId keep = Add({3, 20}, LandmarkState::kConfirmed, {0, 1, 2});
  const LandmarkId drop = Add({-30, 20}, LandmarkState::kConfirmed, {2, 3});
  const int before = store.rewrites();
  store.Fuse(keep, drop);
  EXPECT_GT(store.rewrites(), before);
  ASSERT_EQ(store.all().size(), 1u);
  std::vector<int> rows;
  for (const Sighting& sighting : store.at(keep).sightings) rows.push_back(sighting.detection_row);
  EXPECT_EQ(rows, (std::vector<int>{0, 1, 2, 4}))
      << "where both were seen the kept one's sighting stays";
  EXPECT_EQ(store.at(keep).last_seen, 0.1 * 3);
  EXPECT_TRUE(store.FindWithin({-30, 20}, 5).empty());
}

}  // namespace
}  // namespace sslcd
