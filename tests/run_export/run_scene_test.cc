// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_scene.h"

#include "small_run.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

TEST(RunScene, HasNamesAndColours) {
  const RunScene scene = SceneOf(SmallRun());
  EXPECT_EQ(scene.name, "small");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "Car 12");
  EXPECT_FALSE(scene.objects[0].round);
  EXPECT_EQ(scene.objects[1].name, "Tree< 3");
  EXPECT_TRUE(scene.objects[1].round);
  EXPECT_EQ(Hex(scene.objects[1].colour), Hex(LabelColour(1)));
  ASSERT_EQ(scene.paths.size(), 2u);
  EXPECT_EQ(scene.paths[1].name, "corrected trajectory");
  EXPECT_EQ(scene.paths[1].points.size(), 3u);
  ASSERT_EQ(scene.loops.size(), 1u) << "accepted ones alone";
  EXPECT_EQ(scene.loops[0].name, "loop 2 to 0");
  EXPECT_EQ(scene.loops[0].match, scene.paths[1].points[0]);
  EXPECT_EQ(scene.loops[0].query, scene.paths[1].points[2]);
}

TEST(RunScene, TruthIsAPath) {
  RunView run = SmallRun();
  run.truth = run.trajectory;
  EXPECT_EQ(SceneOf(run).paths.at(2).name, "ground truth");
}

TEST(RunScene, WhatCannotBeExported) {
  RunView run;
  run.folder = "runs/empty";
  ExpectError([&] { SceneOf(run); }, {"runs/empty: the run has no poses"});
  run = SmallRun();
  run.odometry.poses[2] = Pose::Trans(0, 0, 2e6);
  ExpectError([&] { SceneOf(run); }, {"runs/small: 'odometry' reaches farther than 1000 km"});
  run = SmallRun();
  run.map.objects[0].dims.x() = 1e300;
  ExpectError([&] { SceneOf(run); }, {"'Tree< 3'"});
}

}  // namespace
}  // namespace sslcd
