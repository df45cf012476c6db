// SPDX-License-Identifier: BSD-3-Clause
#include "closing/split_fused.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "refine/fuse.h"

namespace sslcd {
namespace {

const Pose kDrift = Pose::Trans(1, 0, 0.5);

struct Parked {
  std::string label;
  Vec3 place;
  double yaw = 0.3;
  float colour = 0;
};

// A camera drives past objects, metre by metre and ten metres a second, and comes back after 300 m.
// Each visit is associated by itself, since odometry has drifted. No noise.
struct Visits {
  Visits() { Visit(objects); }

  // Drives past these objects from one place to another, in a world that is off by `drift`.
  void Visit(const std::vector<Parked>& parked, const Pose& drift = {}, int from = 0, int to = 20) {
    for (int i = from; i < to; ++i) {
      FrameRecord record;
      record.frame = 10 * state.frames.size();  // numbers are not indices
      record.stamp = 0.1 * record.frame;
      record.T_odom_cam = Pose::Trans(0, 0, path_m + i);
      record.T_world_cam = drift * Pose::Trans(0, 0, i);
      for (const Parked& object : parked) See(object, Pose::Trans(0, 0, i), record);
      const std::vector<Detection> seen = record.detections;
      for (Detection& detection : record.detections) detection.appearance = {};
      state.frames.Append(record);
      state.frames.SetMatched(state.frames.size() - 1,
                              state.map
                                  .AddFrame(record.frame, record.stamp, record.T_world_cam, seen,
                                            nullptr, state.frames.back().travelled)
                                  .matched);
      passes.AddFrame(state, seen);
    }
    path_m += to < 20 ? 0 : 300;
  }

  void Fuse(const std::vector<std::pair<LandmarkId, LandmarkId>>& pairs) {
    const MergedIds merged = FuseMatched(state, pairs, options);
    ASSERT_EQ(merged.size(), pairs.size());
    passes.Rename(merged);
  }
  void RenameIn(int f, const MergedIds& merged) {
    std::vector<LandmarkId> matched = state.frames[f].matched;
    for (LandmarkId& id : matched) id = Resolve(id, merged);
    state.frames.SetMatched(f, matched);
  }
  void Rename(const MergedIds& merged) {
    for (int f = 0; f < state.frames.size(); ++f) RenameIn(f, merged);
    passes.Rename(merged);
  }
  void Split() { SplitFused(state, passes, options); }

  const MapLandmark& At(int id) const { return state.map.at({id}); }

  static LabelTable Labels() {
    LabelTable labels;
    labels.Set("Tree", {Symmetry::kFull});
    return labels;
  }

  void See(const Parked& object, const Pose& T_true_cam, FrameRecord& record) {
    Detection detection;
    detection.T_cam_object = T_true_cam.inverse() * ToPose({object.place, object.yaw}, gravity);
    if (detection.T_cam_object.translation().z() < 1) return;
    detection.label = object.label;
    detection.row = next_row++;
    detection.dims = object.label == "Car" ? Vec3(4, 1.7, 1.5) : Vec3(0.4, 0.4, 3);
    detection.appearance[Cue::kColour] = {object.colour, 1 - object.colour};
    record.detections.push_back(detection);
  }

  std::vector<Parked> objects{{"Car", {3, 1, 22}, 0.3, 0.f}, {"Tree", {-4, 1, 12}, 0, 1.f}};
  GravityFrame gravity;
  WholeMapOptions options;
  MapState state{ObjectMap(gravity, Labels(), {}, {}, {}), {}};
  PassMap passes{{}, 30.};
  double path_m = 0;
  int next_row = 0;
};

std::vector<std::pair<int, int>> RowsOf(const MapLandmark& landmark) {
  std::vector<std::pair<int, int>> rows;
  for (const Sighting& sighting : landmark.sightings)
    rows.push_back({sighting.frame, sighting.detection_row});
  return rows;
}

void ExpectSame(const MapLandmark& now, const MapLandmark& before) {
  SCOPED_TRACE(before.id.value);
  EXPECT_EQ(now.id, before.id);
  EXPECT_EQ(now.label, before.label);
  EXPECT_EQ(now.state, before.state);
  EXPECT_LT((now.pose.position - before.pose.position).norm(), 1e-6);
  if (CanMove(before)) {
    EXPECT_NEAR(now.pose.yaw, before.pose.yaw, 1e-6);
  }
  EXPECT_LT((now.dims - before.dims).norm(), 1e-9);
  EXPECT_EQ(RowsOf(now), RowsOf(before));
  EXPECT_EQ(now.last_seen, before.last_seen);
  EXPECT_EQ(now.last_seen_at, before.last_seen_at);
  EXPECT_EQ(now.motion.count(), before.motion.count());
  const auto views = now.appearance[Cue::kColour].Views();
  const auto earlier = before.appearance[Cue::kColour].Views();
  ASSERT_EQ(views.size(), earlier.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].viewpoint_rad, earlier[i].viewpoint_rad);
    EXPECT_EQ(views[i].count, earlier[i].count);
    EXPECT_EQ(views[i].vector, earlier[i].vector);
  }
}

void ExpectSame(const MapState& now, const MapState& before) {
  ASSERT_EQ(now.map.landmarks().size(), before.map.landmarks().size());
  for (const auto& [id, landmark] : before.map.landmarks()) {
    ExpectSame(now.map.at({id}), landmark);
    EXPECT_EQ(now.map.FindWithin(landmark.pose.position, 0.2), std::vector<LandmarkId>{{id}});
  }
  for (int f = 0; f < before.frames.size(); ++f)
    EXPECT_EQ(now.frames[f].matched, before.frames[f].matched) << f;
}

TEST(SplitFused, GivesTheMapBeforeTheFusion) {
  Visits world;
  world.Visit(world.objects, kDrift);
  const MapState before = world.state;
  ASSERT_EQ(before.map.landmarks().size(), 4u);
  world.Fuse({{{1}, {3}}, {{4}, {2}}});
  ASSERT_EQ(world.state.map.landmarks().size(), 2u);
  world.Split();
  ExpectSame(world.state, before);
  for (const int id : {1, 2, 3, 4}) EXPECT_EQ(world.passes.PassesOf({id}).size(), 1u);
  world.Fuse({{{1}, {3}}});
  EXPECT_EQ(world.passes.PassesOf({1}).size(), 2u) << "can be fused again";
}

TEST(SplitFused, ASingleSightingPlacesItsLandmark) {
  Visits world;
  world.Visit(world.objects, kDrift, 5, 6);
  const Vec3 place = world.At(3).pose.position;
  ASSERT_EQ(world.At(3).sightings.size(), 1u);
  world.Fuse({{{1}, {3}}});
  world.Split();
  EXPECT_LT((world.At(3).pose.position - place).norm(), 1e-6);
  EXPECT_GT((world.At(1).pose.position - place).norm(), 1);
}

TEST(SplitFused, ChangesNothingWhereNothingWasFused) {
  Visits world;
  world.Visit(world.objects, kDrift);
  const int rewrites = world.state.map.rewrites(), generation = world.passes.generation();
  world.Split();
  EXPECT_EQ(world.state.map.rewrites(), rewrites);
  EXPECT_EQ(world.passes.generation(), generation);
}

TEST(SplitFused, ChainsOfFusions) {
  Visits world;
  world.Visit(world.objects, kDrift);
  world.Visit(world.objects, kDrift * kDrift);
  const MapState before = world.state;
  ASSERT_EQ(before.map.landmarks().size(), 6u);
  world.Fuse({{{5}, {3}}});
  world.Fuse({{{1}, {3}}, {{2}, {6}}});
  ASSERT_EQ(world.state.map.landmarks().size(), 3u);
  world.Split();
  ExpectSame(world.state, before);
}

TEST(SplitFused, WhatWasSeenSinceGoesToTheOneThatWasSeenLast) {
  const Pose little = Pose::Trans(0.3, 0, 0.2);
  Visits fused;
  fused.Visit(fused.objects, little, 0, 8);
  Visits unfused = fused;
  fused.Fuse({{{1}, {3}}, {{2}, {4}}});
  for (Visits* world : {&fused, &unfused}) world->Visit(world->objects, little, 8, 20);
  ASSERT_EQ(fused.state.map.landmarks().size(), 2u) << "no more are made";
  fused.Split();
  ExpectSame(fused.state, unfused.state);
}

TEST(SplitFused, TheyAreWhereTheTrajectoryHasThemNow) {
  Visits world;
  world.Visit(world.objects, kDrift);
  world.Fuse({{{1}, {3}}, {{2}, {4}}});
  for (int f = 20; f < world.state.frames.size(); ++f)
    world.state.frames.SetPose(f, Pose::Trans(2, 0, 1) * world.state.frames[f].T_world_cam);
  world.Split();
  for (const int first : {1, 2}) {
    const Vec3 apart = world.At(first + 2).pose.position - world.At(first).pose.position;
    EXPECT_LT((apart - Vec3(3, 0, 1.5)).norm(), 1e-6);
  }
}

// A detector may make two boxes of one object. Where both became one landmark, it keeps one.
TEST(SplitFused, AFrameThatHasSeenBoth) {
  Visits world;
  const Parked car = world.objects[0];
  const Parked twin{car.label, car.place + Vec3(4, 0, 0), car.yaw, 1.f};
  world.Visit({car}, kDrift, 0, 19);
  world.Visit({car, twin}, kDrift, 19, 20);
  world.Visit({twin}, kDrift, 0, 15);
  const MapState before = world.state;
  ASSERT_EQ(before.map.landmarks().size(), 5u);
  world.state.map.Fuse({3}, {4});
  world.Rename({{4, {3}}});
  ASSERT_EQ(world.At(3).sightings.size(), 20u);
  world.Split();
  EXPECT_EQ(RowsOf(world.At(3)), RowsOf(before.map.at({3})));
  EXPECT_EQ(RowsOf(world.At(4)), RowsOf(before.map.at({4})));
}

TEST(SplitFused, WhetherTheyDriveIsAskedAgain) {
  Visits world;
  world.Visit(world.objects, kDrift);
  world.Fuse({{{1}, {3}}, {{2}, {4}}});
  world.state.map.SetState({1}, LandmarkState::kDynamic);  // from one place to the other
  world.Split();
  for (const int id : {1, 3}) EXPECT_EQ(world.At(id).state, LandmarkState::kConfirmed);

  for (int f = 20; f < world.state.frames.size(); ++f)  // the second one drives after all
    world.state.frames.SetPose(
        f, Pose::Trans(0, 0, 0.5 * (f - 20)) * world.state.frames[f].T_world_cam);
  world.Fuse({{{1}, {3}}, {{2}, {4}}});
  world.Split();
  EXPECT_EQ(world.At(1).state, LandmarkState::kConfirmed);
  EXPECT_EQ(world.At(3).state, LandmarkState::kDynamic);
  EXPECT_EQ(world.At(4).state, LandmarkState::kConfirmed) << "trees do not";
}

// A refinement has given the detections of a pass to the landmark of another one, whose own
// landmark is gone or has a few of them left.
TEST(SplitFused, AlsoWhatANewAssociationHasJoined) {
  for (const std::size_t left : {0, 3}) {
    Visits world;
    world.Visit(world.objects, kDrift);
    const MapState before = world.state;
    std::vector<Sighting> to = world.At(1).sightings, from = world.At(3).sightings;
    to.insert(to.end(), from.begin() + left, from.end());
    from.resize(left);
    world.state.map.SetSightings({1}, to);
    world.state.map.SetSightings({3}, from);
    for (int f = 20 + static_cast<int>(left); f < world.state.frames.size(); ++f)
      world.RenameIn(f, {{3, {1}}});
    world.passes.Rebuild(world.state);
    world.Split();
    ExpectSame(world.state, before);
  }
}

}  // namespace
}  // namespace sslcd
