// SPDX-License-Identifier: BSD-3-Clause
#include "closing/global_layout.h"

#include <gtest/gtest.h>

#include <map>

#include "two_visits.h"

namespace sslcd {
namespace {

std::map<int, Vec3> PositionsOf(const std::vector<LayoutObject>& objects) {
  std::map<int, Vec3> positions;
  for (const LayoutObject& object : objects) positions[object.id] = object.position;
  EXPECT_EQ(positions.size(), objects.size()) << "each object once";
  return positions;
}

// Trees along the way; every other one is seen on both visits.
struct Avenue : TwoVisits {
  Avenue() {
    for (int i = 0; i < 8; ++i) {
      trees.push_back(Add({4. + i, 1, 12}));
      See(trees.back(), i, i + 2);
      if (i % 2 == 0) See(trees.back(), 300, 303);
    }
    for (int i = 0; i < 12; ++i) Plan(400 + i, 400 + 10. * i, {});
  }
  std::map<int, Vec3> Listed(double to_m, int min_sightings) const {
    return PositionsOf(Before(to_m, min_sightings).objects);
  }

  std::vector<LandmarkId> trees;
};

TEST(GlobalLayout, HasTheObjectsOfPassesThatEndedBefore) {
  Avenue world;
  world.Drive();
  const LoopOptions options;
  for (const double to_m : {4., 200., 350.}) {
    GlobalLayout global(options);
    const auto objects = PositionsOf(global.Update(world.state, world.passes, to_m).objects());
    EXPECT_EQ(objects, world.Listed(to_m, options.layout.min_sightings));
    EXPECT_EQ(objects.size(), to_m == 4 ? 3u : 8u);
  }
}

TEST(GlobalLayout, ObjectsCountFromTheEndOfTheirFirstPassOn) {
  Avenue world;
  world.Drive();
  GlobalLayout global((LoopOptions()));
  for (const LayoutObject& object : global.Update(world.state, world.passes, 350).objects()) {
    const int tree = object.id - world.trees.front().value;
    EXPECT_EQ(object.since_m, tree + 1) << "its last sighting on the first visit";
  }
}

TEST(GlobalLayout, IsIndexedByTheOptions) {
  Avenue world;
  const LandmarkId once = world.Add({-4, 1, 12});
  world.See(once, 3, 4);
  world.Drive();
  LoopOptions options;
  options.match.max_pair_m = 31;
  options.match.reach_m = 7;
  for (const int min_sightings : {1, 2}) {
    options.layout.min_sightings = min_sightings;
    GlobalLayout global(options);
    const LayoutIndex& index = global.Update(world.state, world.passes, 200);
    EXPECT_EQ(index.max_pair(), 31);
    EXPECT_EQ(index.reach(), 7);
    EXPECT_EQ(index.objects().size(), min_sightings == 1 ? 9u : 8u);
  }
}

TEST(GlobalLayout, FollowsEveryChangeOfTheMap) {
  Avenue world;
  GlobalLayout global((LoopOptions()));
  while (!world.to_come.empty()) {
    world.Drive(1);
    const int frame = world.state.frames.back().frame;
    if (frame == 302) world.map.SetState(world.trees[0], LandmarkState::kDynamic);
    if (frame == 305) world.Move(13, Pose::Trans(0.5, 0, 0));  // the sliding window
    if (frame == 309) world.Move(0, Pose::Trans(0, 0, 3));     // a loop
    if (frame == 401) {
      world.Rematch(world.trees[2], world.trees[1]);
      world.passes.Rename({{world.trees[2].value, world.trees[1]}});
    }
    if (frame == 405) world.passes.Rebuild(world.state);
    const double to_m = world.state.frames.back().travelled - 4;
    ASSERT_EQ(PositionsOf(global.Update(world.state, world.passes, to_m).objects()),
              world.Listed(to_m, 2))
        << frame;
  }
  EXPECT_EQ(global.Update(world.state, world.passes, 500).objects().size(), 6u);
  EXPECT_EQ(PositionsOf(global.Update(world.state, world.passes, 4).objects()), world.Listed(4, 2))
      << "back in time";
}

TEST(GlobalLayout, ACopyIsUpdatedOnItsOwn) {
  Avenue world;
  world.Drive(12);
  GlobalLayout global((LoopOptions()));
  const auto before = PositionsOf(global.Update(world.state, world.passes, 5).objects());
  GlobalLayout copy = global;
  world.Drive();
  EXPECT_EQ(PositionsOf(copy.Update(world.state, world.passes, 390).objects()),
            world.Listed(390, 2));
  EXPECT_NE(world.Listed(390, 2), before);
  EXPECT_EQ(PositionsOf(global.Update(world.state, world.passes, 390).objects()),
            world.Listed(390, 2))
      << "the copy has not used up its changes";
}

TEST(GlobalLayout, EmptyWithoutFinishedPasses) {
  TwoVisits world;
  GlobalLayout global((LoopOptions()));
  world.Drive(1);
  EXPECT_TRUE(global.Update(world.state, world.passes, 1000).objects().empty());
}

}  // namespace
}  // namespace sslcd
