// SPDX-License-Identifier: BSD-3-Clause
#include "report/loop_crops.h"

#include <gtest/gtest.h>

#include <set>

namespace sslcd {
namespace {

const Camera kCamera{500, 500, 320, 240, {0, 0, 0}, 640, 480};

// Two passes by five cars, each seen in frames 0 to 9 and 400 to 409; the fifth in the first only.
RunView TwoPasses() {
  RunView run;
  for (int i = 0; i < 410; ++i) {
    run.trajectory.stamps.push_back(.1 * i);
    run.trajectory.poses.push_back(Pose::Trans(0, 0, i < 400 ? .1 * i : .1 * (i - 400)));
  }
  LoopClosure loop;
  loop.decision = LoopDecision::kAccepted;
  loop.query_frame = 409;
  loop.match_frame = 9;
  for (int id = 0; id < 5; ++id) {
    MapObject object;
    object.id.value = id;
    object.T_world_object = Pose(run.gravity.Upright(0), Vec3(2. * id - 4, 1, 12));
    object.dims = Vec3(1, 1, 1.5);
    for (int i = 0; i < 10; ++i) {
      object.observations.push_back({i, 0});
      if (id < 4) object.observations.push_back({400 + i, 0});
    }
    run.map.objects.push_back(object);
    loop.pairs.push_back({{id == 0 ? 77 : id}, {id}});  // 77 was fused
  }
  run.loops = {loop};
  return run;
}

TEST(SeenPairs, ShowsWhatBothSidesHaveSeen) {
  const std::vector<SeenPair> pairs = SeenPairs(TwoPasses(), kCamera);
  ASSERT_EQ(pairs.size(), 4u) << "the fifth was not seen near the query";
  for (const SeenPair& pair : pairs) {
    EXPECT_EQ(pair.query.frame, 409) << "where the objects are largest";
    EXPECT_EQ(pair.match.frame, 9);
    const double x = 500 * (2. * double(pair.pair) - 4) / 11.1 + 320;
    EXPECT_LT(pair.query.box.left, x);
    EXPECT_GT(pair.query.box.right, x);
    EXPECT_NEAR(pair.query.box.left, pair.match.box.left, 1e-9);
  }
}

TEST(SeenPairs, TellsObjectsApartThatTheBorderOfTheImageCuts) {
  RunView run = TwoPasses();
  for (int id = 0; id < 2; ++id)  // above each other
    run.map.objects[std::size_t(id)].T_world_object.translation() = Vec3(-7.8, 2. * id, 12);
  std::set<std::pair<int, int>> objects;
  for (const SeenPair& pair : SeenPairs(run, kCamera)) {
    EXPECT_EQ(pair.query.object, int(pair.pair));
    EXPECT_EQ(pair.match.object, int(pair.pair));
    if (pair.query.box.left == 0) objects.insert({pair.query.frame, pair.query.object});
  }
  EXPECT_EQ(objects.size(), 2u);
}

TEST(SeenPairs, KeepsItsLimits) {
  RunView run = TwoPasses();
  EXPECT_EQ(SeenPairs(run, kCamera, {120, 2}).size(), 2u);
  run.loops.resize(7, run.loops[0]);
  EXPECT_EQ(SeenPairs(run, kCamera, {3, 5}).size(), 3 * 4u) << "each third of seven";
}

TEST(SeenPairs, LeavesOutWhatIsBehindSomething) {
  RunView run = TwoPasses();
  MapObject front = run.map.objects[1];
  front.id.value = 50;
  front.T_world_object.translation() *= .9;
  run.map.objects.push_back(front);
  EXPECT_EQ(SeenPairs(run, kCamera).size(), 3u);
  for (Observation& seen : run.map.objects.back().observations) seen.frame += 10;
  EXPECT_EQ(SeenPairs(run, kCamera).size(), 4u) << "not in front in those frames";
}

TEST(SeenPairs, LeavesOutWhatNobodyCouldSee) {
  RunView run = TwoPasses();
  run.loops[0].decision = LoopDecision::kAmbiguous;
  EXPECT_TRUE(SeenPairs(run, kCamera).empty());
  run = TwoPasses();
  for (MapObject& object : run.map.objects) object.dims *= .01;
  EXPECT_TRUE(SeenPairs(run, kCamera).empty()) << "too small";
  run = TwoPasses();
  run.map.objects.clear();
  EXPECT_TRUE(SeenPairs(run, kCamera).empty());
  run = TwoPasses();
  for (MapObject& object : run.map.objects) object.observations = {{-1, 0}, {5000, 0}};
  EXPECT_TRUE(SeenPairs(run, kCamera).empty()) << "frames that are not there";
  EXPECT_TRUE(SeenPairs(RunView(), kCamera).empty());
}

}  // namespace
}  // namespace sslcd
