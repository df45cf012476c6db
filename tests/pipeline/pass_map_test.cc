// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/pass_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace sslcd {
namespace {

// A camera drives past one place twice, 300 m of path between the visits: frames 0..9 and 300..309,
// a metre a frame. World axes are the first camera's (y down); layouts have x = world x, y = world
// z.
struct TwoVisits {
  std::vector<FrameRecord> frames;
  ObjectMap map{GravityFrame{}, LabelTable{}, {}, {}, {}};
  PassMap passes{map, frames, {}, 30.};

  TwoVisits() {
    for (const int first : {0, 300}) {
      for (int i = 0; i < 10; ++i) {
        FrameRecord record;
        record.frame = first + i;
        record.travelled = record.frame;
        record.T_odom_cam = record.T_world_cam = Pose::Trans(0, 0, i);
        frames.push_back(record);
      }
    }
  }

  LandmarkId Add(const Vec3& position, const std::string& label = "Tree", double yaw = 0) {
    MapLandmark landmark;
    landmark.label = label;
    landmark.symmetry = label == "Tree" ? Symmetry::kFull : Symmetry::kNone;
    landmark.state = LandmarkState::kConfirmed;
    landmark.pose = {position, yaw};
    return map.Insert(landmark);
  }

  // Seen by the frames numbered from `first` to before `end`, without error with respect to where
  // they are now.
  void See(LandmarkId id, int first, int end) {
    for (FrameRecord& record : frames) {
      if (record.frame < first || record.frame >= end) continue;
      Detection detection;
      detection.T_cam_object =
          record.T_world_cam.inverse() * ToPose(map.at(id).pose, map.gravity());
      record.detections.push_back(detection);
      record.matched.push_back(id);
    }
  }

  // The frames come in one by one.
  void Drive() {
    std::vector<FrameRecord> all;
    all.swap(frames);
    for (FrameRecord& record : all) {
      frames.push_back(std::move(record));
      passes.Update();
    }
  }

  // The second visit, as odometry that has drifted has it.
  void ShiftSecondVisit(const Vec3& by) {
    for (FrameRecord& record : frames)
      if (record.frame >= 300) record.T_world_cam = Pose::Trans(by) * record.T_world_cam;
  }
};

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

  const PassLayout recent = world.passes.Recent(290, 2), before = world.passes.Before(200, 2);
  ASSERT_EQ(recent.objects.size(), 1u);
  ASSERT_EQ(before.objects.size(), 1u);
  EXPECT_EQ(recent.objects[0].id, tree.value);
  EXPECT_EQ(before.objects[0].id, tree.value);
  ExpectAt(before.objects[0], 4, 12, -1);
  ExpectAt(recent.objects[0], 5, 14, -1);
  EXPECT_NEAR(recent.seen_m[0], 302.5, 1e-9);
  EXPECT_NEAR((before.places[0].position - Vec3(4, 1, 12)).norm(), 0, 1e-9);
}

TEST(PassMap, AllFramesAtOnceAreTheSame) {
  TwoVisits one_by_one, at_once;
  for (TwoVisits* world : {&one_by_one, &at_once}) {
    const LandmarkId tree = world->Add({4, 1, 12});
    world->See(tree, 2, 8);
    world->See(tree, 301, 305);
  }
  one_by_one.Drive();
  at_once.passes.Update();
  ASSERT_EQ(at_once.passes.passes().size(), one_by_one.passes.passes().size());
  for (std::size_t i = 0; i < at_once.passes.passes().size(); ++i) {
    EXPECT_EQ(at_once.passes.passes()[i].sightings, one_by_one.passes.passes()[i].sightings);
    EXPECT_EQ(at_once.passes.passes()[i].anchor, one_by_one.passes.passes()[i].anchor);
  }
}

TEST(PassMap, EachPassKnowsHowItsObjectLooked) {
  TwoVisits world;
  const LandmarkId car = world.Add({4, 1, 12}, "Car");
  world.See(car, 0, 5);
  world.See(car, 300, 305);
  for (FrameRecord& record : world.frames)
    for (Detection& detection : record.detections)
      detection.embedding =
          record.frame < 300 ? std::vector<float>{1, 0} : std::vector<float>{0, 1};
  world.Drive();
  const auto mean_of_views = [](const LayoutObject& object) {
    Eigen::Vector2d sum(0, 0);
    double count = 0;
    for (const AppearanceView& view : object.embedding) {
      sum += view.count * Eigen::Vector2d(view.vector[0], view.vector[1]);
      count += view.count;
    }
    EXPECT_EQ(count, 5);
    return Eigen::Vector2d(sum / count);
  };
  const auto expect_both = [&] {
    const PassLayout old = world.passes.Before(200, 1), recent = world.passes.Recent(250, 1);
    ASSERT_EQ(old.objects.size(), 1u);
    ASSERT_EQ(recent.objects.size(), 1u);
    EXPECT_EQ(mean_of_views(old.objects[0]), Eigen::Vector2d(1, 0))
        << "nothing of the second visit";
    EXPECT_EQ(mean_of_views(recent.objects[0]), Eigen::Vector2d(0, 1));
    EXPECT_TRUE(old.objects[0].colour.empty());
  };
  expect_both();
  for (FrameRecord& record : world.frames)
    for (Detection& detection : record.detections) detection.embedding.clear();
  world.passes.Rebuild();
  expect_both();
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
  world.passes.Update();
  EXPECT_EQ(world.passes.Before(200, 2).objects.size(), 1u);
  EXPECT_EQ(world.passes.Before(200, 1).objects.size(), 2u);
  EXPECT_EQ(world.passes.Before(4, 1).objects.size(), 1u) << "passes that ended by then";
  EXPECT_EQ(world.passes.Before(1000, 1).objects.size(), 2u) << "finished ones only";
  EXPECT_EQ(world.passes.Recent(290, 5).objects.size(), 1u);
  EXPECT_EQ(world.passes.Recent(303, 3).objects.size(), 0u) << "only sightings since then count";
  EXPECT_EQ(world.passes.Recent(303, 2).objects.size(), 1u);
  EXPECT_EQ(world.passes.Between(0, 100, 2).objects.size(), 1u)
      << "as it was then: one once, one not at all yet";
  EXPECT_EQ(world.passes.Between(0, 100, 1).objects.size(), 2u);
  EXPECT_EQ(world.passes.Between(0, 1, 3).objects.size(), 0u) << "nor do later sightings count";
  EXPECT_TRUE(world.passes.Between(100, 0, 1).objects.empty());
}

TEST(PassMap, LabelsAndHeadings) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12}), other = world.Add({4, 1, 16});
  const LandmarkId car = world.Add({-4, 1, 12}, "Car", 0.4);
  for (const LandmarkId id : {tree, other, car}) world.See(id, 0, 6);
  // once the detector takes the car's front for its back
  FrameRecord& turned_round = world.frames[2];
  turned_round.detections[2].T_cam_object.so3() = GravityFrame().Upright(0.4 + M_PI);
  world.passes.Update();
  const PassLayout layout = world.passes.Before(200, 1);
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
  world.passes.Update();
  for (FrameRecord& record : world.frames)
    record.T_world_cam = Pose::Trans(0, -7, 3) * record.T_world_cam;
  const PassLayout layout = world.passes.Before(200, 1);
  ASSERT_EQ(layout.objects.size(), 1u);
  ExpectAt(layout.objects[0], 4, 15, -1);  // the height is over the camera, which rose with it
  EXPECT_NEAR(layout.places[0].position.y(), -6, 1e-9);
}

TEST(PassMap, AfterFusionBothPassesAreOnes) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}), late = world.Add({6, 1, 12});
  world.See(early, 0, 6);
  world.See(late, 300, 302);
  FrameRecord end;
  end.frame = 400;
  end.travelled = 400;
  world.frames.push_back(end);
  world.passes.Update();
  world.passes.Rename({{late.value, {55}}, {55, early}});  // through one that is gone, too
  const PassLayout layout = world.passes.Before(390, 1);
  ASSERT_EQ(layout.objects.size(), 1u);
  EXPECT_EQ(layout.objects[0].id, early.value);
  ExpectAt(layout.objects[0], 4.5, 12, -1);  // six sightings and two
  EXPECT_EQ(world.passes.NearestPass(early, 20), 3);
  EXPECT_EQ(world.passes.NearestPass(early, 250), 301);
  EXPECT_EQ(world.passes.NearestPass(late, 250), 250) << "has none";
}

// What a caller has who follows the changes.
void Follow(const LayoutChanges& changes, std::map<int, LayoutObject>& objects) {
  if (changes.anew) objects.clear();
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
  for (int i = 0; i < 12; ++i) {
    FrameRecord record;
    record.frame = 400 + i;
    record.travelled = 400 + 10. * i;
    world.frames.push_back(record);
  }
  std::map<int, LayoutObject> followed;
  std::vector<FrameRecord> all;
  all.swap(world.frames);
  int updates = 0, listed = 0;
  for (const FrameRecord& record : all) {
    world.frames.push_back(record);
    world.passes.Update();
    if (record.frame == 302) world.map.SetState(trees[0], LandmarkState::kDynamic);
    if (record.frame == 305) {  // the sliding window
      world.passes.MovedFrom(13);
      for (std::size_t f = 13; f < world.frames.size(); ++f)
        world.frames[f].T_world_cam = Pose::Trans(.5, 0, 0);
    }
    if (record.frame == 309) {  // a loop
      world.passes.MovedFrom(0);
      for (FrameRecord& frame : world.frames)
        frame.T_world_cam = Pose::Trans(0, 0, 3) * frame.T_world_cam;
    }
    if (record.frame == 401) {
      for (FrameRecord& frame : world.frames)
        for (LandmarkId& id : frame.matched)
          if (id == late) id = trees[1];
      world.passes.Rename({{late.value, trees[1]}});
    }
    const double old_until = record.travelled - 4;
    const LayoutChanges changes = world.passes.ChangesBefore(old_until, 2);
    updates += !changes.anew;
    Follow(changes, followed);
    const PassLayout before = world.passes.Before(old_until, 2);
    ASSERT_EQ(followed.size(), before.objects.size()) << record.frame;
    for (std::size_t i = 0; i < before.objects.size(); ++i) {
      const LayoutObject& object = before.objects[i];
      ASSERT_EQ(followed.count(object.id), 1u);
      EXPECT_EQ(followed[object.id].position, object.position) << record.frame;
      EXPECT_EQ(world.passes.PlaceBefore({object.id}, old_until, 2)->position,
                before.places[i].position);
      ++listed;
    }
  }
  EXPECT_EQ(updates, 30) << "the first frame and the loop are the others";
  EXPECT_GT(listed, 100);
  EXPECT_TRUE(world.passes.ChangesBefore(510 - 4, 2).objects.empty()) << "told already";
  EXPECT_TRUE(world.passes.ChangesBefore(200, 2).anew) << "back in time";
  EXPECT_TRUE(world.passes.ChangesBefore(200, 1).anew);
  EXPECT_EQ(world.passes.PlaceBefore(late, 500, 2), std::nullopt) << "has another name";
}

TEST(PassMap, AnOpenPassGoesOnUnderItsNewName) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}), late = world.Add({4, 1, 12});
  world.See(early, 0, 6);
  world.See(late, 300, 303);
  const std::vector<FrameRecord> all = world.frames;
  world.frames.resize(13);
  world.passes.Update();
  world.passes.Rename({{late.value, early}});
  world.frames = all;
  for (FrameRecord& record : world.frames)
    for (LandmarkId& id : record.matched) id = early;
  world.See(early, 304, 306);
  world.passes.Update();
  ASSERT_EQ(world.passes.passes().size(), 2u);
  EXPECT_EQ(world.passes.passes()[1].sightings.size(), 5u);
}

TEST(PassMap, NothingSeen) {
  TwoVisits world;
  world.passes.Update();
  EXPECT_TRUE(world.passes.Recent(0, 1).objects.empty());
  EXPECT_TRUE(world.passes.Before(1000, 1).objects.empty());
  world.frames.clear();
  PassMap none(world.map, world.frames, {}, 30.);
  none.Update();
  EXPECT_TRUE(none.Recent(0, 0).objects.empty());
}

}  // namespace
}  // namespace sslcd
