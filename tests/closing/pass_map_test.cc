// SPDX-License-Identifier: BSD-3-Clause
#include "closing/pass_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "two_visits.h"

namespace sslcd {
namespace {

void ExpectAt(const LayoutObject& object, double x, double y, double height) {
  EXPECT_NEAR(object.position.x(), x, 1e-9);
  EXPECT_NEAR(object.position.y(), y, 1e-9);
  EXPECT_NEAR(object.position.z(), height, 1e-9);
}

TEST(PassMap, OneLandmarkHasAPassForEachVisit) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12});
  world.See(tree, 2, 8);
  world.See(tree, 301, 305);
  world.ShiftSecondVisit({1, 0, 2});
  world.Drive();
  ASSERT_EQ(world.passes.passes().size(), 2u);
  const PassObject &early = world.passes.passes()[0], &late = world.passes.passes()[1];
  EXPECT_EQ(early.first_m, 2);
  EXPECT_EQ(early.last_m, 7);
  EXPECT_EQ(early.sightings.size(), 6u);
  EXPECT_EQ(early.anchor, 5);
  EXPECT_EQ(late.first_m, 301);
  EXPECT_EQ(late.anchor, -1) << "not over yet";
  EXPECT_NEAR(early.height_m, -1, 1e-9);

  const PassLayout recent = world.Recent(290, 2), before = world.Before(200, 2);
  ASSERT_EQ(recent.objects.size(), 1u);
  ASSERT_EQ(before.objects.size(), 1u);
  EXPECT_EQ(recent.objects[0].id, tree.value);
  EXPECT_EQ(before.objects[0].id, tree.value);
  ExpectAt(before.objects[0], 4, 12, -1);
  ExpectAt(recent.objects[0], 5, 14, -1);
  EXPECT_NEAR(recent.seen_m[0], 302.5, 1e-9);
  EXPECT_NEAR((before.places[0].position - Vec3(4, 1, 12)).norm(), 0, 1e-9);
}

TEST(PassMap, RebuildingChangesNothing) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12});
  world.See(tree, 2, 8);
  world.See(tree, 301, 305);
  world.Drive();
  const std::vector<PassObject> before = world.passes.passes();
  world.passes.Rebuild(world.state);
  ASSERT_EQ(world.passes.passes().size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(world.passes.passes()[i].sightings, before[i].sightings);
    EXPECT_EQ(world.passes.passes()[i].anchor, before[i].anchor);
  }
}

// A car that shows another side of this cue on each of its two visits.
void ExpectTheLooksOfEachPass(Cue cue) {
  TwoVisits world;
  const LandmarkId car = world.Add({4, 1, 12}, "Car");
  world.See(car, 0, 5);
  world.See(car, 300, 305);
  for (FrameRecord& record : world.to_come)
    for (Detection& detection : record.detections)
      detection.appearance[cue] =
          record.frame < 300 ? std::vector<float>{1, 0} : std::vector<float>{0, 1};
  world.Drive();
  const auto mean_of_views = [cue](const LayoutObject& object) {
    Eigen::Vector2d sum(0, 0);
    double count = 0;
    for (const AppearanceView& view : object.appearance[cue]) {
      sum += view.count * Eigen::Vector2d(view.vector[0], view.vector[1]);
      count += view.count;
    }
    EXPECT_EQ(count, 5);
    return Eigen::Vector2d(sum / count);
  };
  const auto expect_both = [&] {
    const PassLayout old = world.Before(200, 1), recent = world.Recent(250, 1);
    ASSERT_EQ(old.objects.size(), 1u);
    ASSERT_EQ(recent.objects.size(), 1u);
    EXPECT_EQ(mean_of_views(old.objects[0]), Eigen::Vector2d(1, 0))
        << "nothing of the second visit";
    EXPECT_EQ(mean_of_views(recent.objects[0]), Eigen::Vector2d(0, 1));
    for (const CueRow& other : kCueRows)
      EXPECT_EQ(old.objects[0].appearance[other.cue].empty(), other.cue != cue);
  };
  expect_both();
  world.passes.Rebuild(world.state);
  expect_both();
}

TEST(PassMap, EachPassKnowsHowItsObjectLooked) {
  for (const CueRow& row : kCueRows) {
    SCOPED_TRACE(row.name);
    ExpectTheLooksOfEachPass(row.cue);
  }
}

TEST(PassMap, WhatTakesPart) {
  TwoVisits world;
  const LandmarkId often = world.Add({4, 1, 12}), once = world.Add({-4, 1, 12}),
                   driving = world.Add({0, 1, 20}, "Car");
  const LandmarkId late = world.Add({4, 1, 20});
  world.See(often, 0, 5);
  world.See(once, 3, 4);
  world.See(driving, 0, 5);
  world.See(late, 300, 305);
  world.map.SetState(driving, LandmarkState::kDynamic);
  world.Drive();
  EXPECT_EQ(world.Before(200, 2).objects.size(), 1u);
  EXPECT_EQ(world.Before(200, 1).objects.size(), 2u);
  EXPECT_EQ(world.Before(4, 1).objects.size(), 1u) << "passes that ended by then";
  EXPECT_EQ(world.Before(1000, 1).objects.size(), 2u) << "finished ones only";
  EXPECT_EQ(world.Recent(290, 5).objects.size(), 1u);
  EXPECT_EQ(world.Recent(303, 3).objects.size(), 0u) << "only sightings since then count";
  EXPECT_EQ(world.Recent(303, 2).objects.size(), 1u);
  EXPECT_EQ(world.Between(0, 100, 2).objects.size(), 1u)
      << "as it was then: one once, one not at all yet";
  EXPECT_EQ(world.Between(0, 100, 1).objects.size(), 2u);
  EXPECT_EQ(world.Between(0, 1, 3).objects.size(), 0u) << "nor do later sightings count";
  EXPECT_TRUE(world.Between(100, 0, 1).objects.empty());
}

TEST(PassMap, LabelsAndHeadings) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12}), other = world.Add({4, 1, 16});
  const LandmarkId car = world.Add({-4, 1, 12}, "Car", 0.4);
  for (const LandmarkId id : {tree, other, car}) world.See(id, 0, 6);
  // once the detector takes the car's front for its back
  FrameRecord& turned_round = world.to_come[2];
  turned_round.detections[2].T_cam_object.so3() = GravityFrame().Upright(0.4 + M_PI);
  world.Drive();
  const PassLayout layout = world.Before(200, 1);
  ASSERT_EQ(layout.objects.size(), 3u);
  EXPECT_EQ(layout.objects[0].label, layout.objects[1].label);
  EXPECT_NE(layout.objects[0].label, layout.objects[2].label);
  EXPECT_EQ(layout.objects[0].symmetry, Symmetry::kFull);
  EXPECT_TRUE(std::isnan(layout.objects[0].yaw)) << "a tree has no heading";
  EXPECT_NEAR(WrapAngle(layout.objects[2].yaw - 0.4), 0, 1e-6);
}

TEST(PassMap, FinishedPassesMoveWithTheirAnchors) {
  TwoVisits world;
  world.See(world.Add({4, 1, 12}), 0, 6);
  world.Drive();
  world.Move(0, Pose::Trans(0, -7, 3));
  const PassLayout layout = world.Before(200, 1);
  ASSERT_EQ(layout.objects.size(), 1u);
  ExpectAt(layout.objects[0], 4, 15, -1);  // the height is over the camera, which rose with it
  EXPECT_NEAR(layout.places[0].position.y(), -6, 1e-9);
}

TEST(PassMap, AfterFusionBothPassesAreOnes) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}), late = world.Add({6, 1, 12});
  world.See(early, 0, 6);
  world.See(late, 300, 302);
  world.Plan(400, 400, {});
  world.Drive();
  world.passes.Rename({{late.value, {55}}, {55, early}});  // through one that is gone, too
  const PassLayout layout = world.Before(390, 1);
  ASSERT_EQ(layout.objects.size(), 1u);
  EXPECT_EQ(layout.objects[0].id, early.value);
  ExpectAt(layout.objects[0], 4.5, 12, -1);  // six sightings and two
  EXPECT_EQ(world.passes.NearestPass(world.state.frames, early, 20), 3);
  EXPECT_EQ(world.passes.NearestPass(world.state.frames, early, 250), 301);
  EXPECT_EQ(world.passes.NearestPass(world.state.frames, late, 250), 250) << "has none";
}

// The state of a caller that applies the changes.
void Follow(const LayoutChanges& changes, std::map<int, LayoutObject>& objects) {
  if (changes.all) objects.clear();
  for (const LayoutObject& object : changes.objects) objects[object.id] = object;
  for (const int id : changes.gone) objects.erase(id);
}

TEST(PassMap, ChangesAddUpToWhatItLists) {
  TwoVisits world;
  std::vector<LandmarkId> trees;
  for (int i = 0; i < 8; ++i) {
    trees.push_back(world.Add({4. + i, 1, 12}));
    world.See(trees.back(), i, i + 2);
    if (i % 2 == 0) world.See(trees.back(), 300, 303);
  }
  const LandmarkId late = world.Add({-4, 1, 12});
  world.See(late, 300, 304);
  for (int i = 0; i < 12; ++i) world.Plan(400 + i, 400 + 10. * i, {});
  std::map<int, LayoutObject> followed;
  PassLayouts::Mark mark;
  int updates = 0, listed = 0;
  while (!world.to_come.empty()) {
    world.Drive(1);
    const int frame = world.state.frames.back().frame;
    if (frame == 302) world.map.SetState(trees[0], LandmarkState::kDynamic);
    if (frame == 305) world.Move(13, Pose::Trans(.5, 0, 0));  // the sliding window
    if (frame == 309) world.Move(0, Pose::Trans(0, 0, 3));    // a loop
    if (frame == 401) {
      world.Rematch(late, trees[1]);
      world.passes.Rename({{late.value, trees[1]}});
    }
    const double global_end_m = world.state.frames.back().travelled - 4;
    const LayoutChanges changes =
        PassLayouts(world.passes, world.state).ChangesBefore(global_end_m, 2, mark);
    updates += !changes.all;
    Follow(changes, followed);
    const PassLayout before = world.Before(global_end_m, 2);
    ASSERT_EQ(followed.size(), before.objects.size()) << frame;
    for (std::size_t i = 0; i < before.objects.size(); ++i) {
      const LayoutObject& object = before.objects[i];
      ASSERT_EQ(followed.count(object.id), 1u);
      EXPECT_EQ(followed[object.id].position, object.position) << frame;
      EXPECT_EQ(PassLayouts(world.passes, world.state)
                    .PlaceBefore({object.id}, global_end_m, 2)
                    ->position,
                before.places[i].position);
      ++listed;
    }
  }
  EXPECT_EQ(updates, 30) << "the first frame and the loop are the others";
  EXPECT_GT(listed, 100);
  EXPECT_TRUE(
      PassLayouts(world.passes, world.state).ChangesBefore(510 - 4, 2, mark).objects.empty())
      << "told already";
  EXPECT_TRUE(PassLayouts(world.passes, world.state).ChangesBefore(200, 2, mark).all)
      << "back in time";
  PassLayouts::Mark another;
  EXPECT_TRUE(PassLayouts(world.passes, world.state).ChangesBefore(200, 1, another).all)
      << "a new reader";
  world.passes.Rebuild(world.state);
  EXPECT_TRUE(PassLayouts(world.passes, world.state).ChangesBefore(200, 2, mark).all);
  EXPECT_EQ(PassLayouts(world.passes, world.state).PlaceBefore(late, 500, 2), std::nullopt)
      << "has another name";
}

TEST(PassMap, AnOpenPassGoesOnUnderItsNewName) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}), late = world.Add({4, 1, 12});
  world.See(early, 0, 6);
  world.See(late, 300, 303);
  world.Drive(13);
  world.Rematch(late, early);
  world.passes.Rename({{late.value, early}});
  world.See(early, 304, 306);
  world.Drive();
  ASSERT_EQ(world.passes.passes().size(), 2u);
  EXPECT_EQ(world.passes.passes()[1].sightings.size(), 5u);
}

TEST(PassMap, KeepsTheLandmarksThatPassesWereBeforeAFusion) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}), late = world.Add({4, 1, 12});
  world.See(early, 0, 6);
  world.See(late, 300, 303);
  world.Plan(400, 340, {});
  world.Drive(13);
  world.Rematch(late, early);
  world.passes.Rename({{late.value, early}});
  world.See(early, 304, 306);
  world.See(early, 400, 401);  // another pass, but no loop
  world.Drive();
  for (const bool rebuilt : {false, true}) {
    if (rebuilt) world.passes.Rebuild(world.state);
    ASSERT_EQ(world.passes.passes().size(), 3u);
    for (const int pass : {0, 1, 2}) {
      EXPECT_EQ(world.passes.passes()[pass].id, early);
      EXPECT_EQ(world.passes.passes()[pass].own_id, pass == 0 ? early : late)
          << "the one that it was seen as last";
    }
  }
}

TEST(PassMap, ANewAssociationIsWhatMostOfItsSightingsWere) {
  TwoVisits world;
  const LandmarkId one = world.Add({4, 1, 12}), other = world.Add({4, 1, 12});
  world.See(one, 0, 2);
  world.See(other, 2, 5);
  world.Drive();
  world.Rematch(other, one);
  world.passes.Rebuild(world.state);
  ASSERT_EQ(world.passes.passes().size(), 1u);
  EXPECT_EQ(world.passes.passes()[0].id, one);
  EXPECT_EQ(world.passes.passes()[0].own_id, other);
}

TEST(PassMap, LooksStayWithHalfOfTheSightings) {
  for (const int moved : {1, 2, 3}) {
    TwoVisits world;
    const LandmarkId one = world.Add({4, 1, 12}), other = world.Add({4, 1, 12});
    world.See(one, 0, 4);
    for (FrameRecord& record : world.to_come)
      for (Detection& detection : record.detections)
        detection.appearance[Cue::kColour] = {1.f, 0.f};
    world.Drive();
    for (int f = 0; f < moved; ++f) world.state.frames.SetMatched(f, {other});
    world.passes.Rebuild(world.state);
    const auto views = [&](LandmarkId id) {
      const int pass = world.passes.PassesOf(id).at(0);
      return world.passes.passes()[pass].appearance[Cue::kColour].Views().size();
    };
    EXPECT_EQ(views(other) > 0, moved >= 2) << moved << " of 4, the first ones";
    EXPECT_EQ(views(one) > 0, moved < 2) << moved;
  }
}

TEST(PassMap, NearestSightingAlongThePath) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12}), other = world.Add({-4, 1, 12});
  world.See(other, 0, 10);
  world.See(tree, 2, 6);
  world.See(tree, 300, 303);
  world.Drive();
  const auto nearest = [&](double path_m) {
    return world.passes.NearestSighting(world.state.frames, tree, path_m);
  };
  EXPECT_EQ(nearest(0), std::make_pair(2, 1));
  EXPECT_EQ(nearest(4.2), std::make_pair(4, 1));
  EXPECT_EQ(nearest(400), std::make_pair(12, 0));
  EXPECT_FALSE(world.passes.NearestSighting(world.state.frames, {77}, 4));
}

TEST(PassMap, NothingSeen) {
  TwoVisits world;
  world.Drive();
  EXPECT_TRUE(world.Recent(0, 1).objects.empty());
  EXPECT_TRUE(world.Before(1000, 1).objects.empty());
  const TwoVisits none;
  EXPECT_TRUE(none.Recent(0, 0).objects.empty());
}

}  // namespace
}  // namespace sslcd
