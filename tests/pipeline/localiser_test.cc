// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/localiser.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "loop_drives.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

// The true objects of a world, as a map in its axes.
ReferenceMap TrueMap(const sim::World& world) {
  ReferenceMap map;
  map.gravity = world.gravity;
  map.labels = world.labels;
  map.label_names = {"Car", "Tree"};
  for (const sim::WorldObject& object : world.objects) {
    const Pose& T_world_object = object.T_world_object.front();
    LayoutObject& of = map.objects.emplace_back();
    of.id = 100 + object.id;
    of.label = object.label == "Tree";
    of.symmetry = world.labels[object.label].symmetry;
    of.position = world.gravity.Basis().transpose() * T_world_object.translation();
    of.altitude = of.position.z();
    of.yaw = of.label == 1 ? std::numeric_limits<double>::quiet_NaN()
                           : world.gravity.YawOf(T_world_object.so3());
    of.dims = object.dims;
  }
  return map;
}

sim::World BlockWorld(std::uint64_t seed) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, seed, world);
  return world;
}

// The drive from one point of the block to another; its odometry has an origin of its own.
Drives Stretch(sim::World world, double from_m, double to_m) {
  Drive(Block(), from_m, to_m, world);
  Drives drives(std::move(world), 7);
  const Pose T_own_odom(lie::SO3<double>::RotY(2), Vec3(40, 0, -9));
  for (Frame& frame : drives.frames) frame.T_odom_cam = T_own_odom * frame.T_odom_cam;
  return drives;
}

std::vector<Localisation> AnswersOf(Localiser& localiser, const Drives& drives) {
  std::vector<Localisation> answers;
  for (const Frame& frame : drives.frames)
    if (auto answer = localiser.AddFrame(frame)) answers.push_back(*std::move(answer));
  return answers;
}

std::string ErrorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

int CountFound(const std::vector<Localisation>& answers) {
  return static_cast<int>(std::count_if(
      answers.begin(), answers.end(),
      [](const Localisation& answer) { return answer.decision == LoopDecision::kAccepted; }));
}

// Both ways along the road, at places all over the map.
TEST(Localiser, FindsTheCamera) {
  const sim::World world = BlockWorld(3);
  const ReferenceMap map = TrueMap(world);
  for (const auto& [from_m, to_m] : {std::pair{20., 120.}, {250., 130.}, {90., 200.}}) {
    Localiser localiser(map, {});
    const Drives drives = Stretch(world, from_m, to_m);
    const std::vector<Localisation> answers = AnswersOf(localiser, drives);
    EXPECT_GE(CountFound(answers), 5) << from_m;
    for (const Localisation& answer : answers) {
      if (answer.decision != LoopDecision::kAccepted) continue;
      const Pose& truth = drives.world.truth.poses[static_cast<std::size_t>(answer.frame)];
      const Vec6 error = (truth.inverse() * answer.T_map_cam).Log();
      EXPECT_LT(error.head<3>().norm(), 1.5) << answer.frame;
      EXPECT_LT(error.tail<3>().norm(), 0.06) << answer.frame;
      // 6 degrees of freedom: 99.99 % lie below 27.9
      const Pose::Matrix6 covariance = answer.covariance;
      const Vec6 weighed = covariance.ldlt().solve(error);
      EXPECT_LT(error.dot(weighed), 27.9) << answer.frame;
      EXPECT_GT(answer.probability, 0.99);
      EXPECT_GE(answer.pairs.size(), 4u);
      for (const auto& [here, there] : answer.pairs) EXPECT_GE(there.value, 100);
      const Pose& T_odom_cam = drives.frames[static_cast<std::size_t>(answer.frame)].T_odom_cam;
      EXPECT_LT((answer.T_map_cam.inverse() * answer.T_map_odom * T_odom_cam).Log().norm(), 1e-9);
    }
  }
}

TEST(Localiser, FindsTheCameraInAMapOfOtherAxes) {
  const Pose T_new_old(lie::SO3<double>::Exp(Vec3(1.2, -0.4, 0.7)), Vec3(5, -6, 7));
  sim::World turned = BlockWorld(3);
  turned.gravity = GravityFrame::FromUp(T_new_old.so3() * turned.gravity.up);
  for (sim::WorldObject& object : turned.objects)
    object.T_world_object.front() = T_new_old * object.T_world_object.front();
  Localiser localiser(TrueMap(turned), {});
  Drives drives = Stretch(BlockWorld(3), 20, 120);
  for (Frame& frame : drives.frames) frame.T_odom_cam = T_new_old * frame.T_odom_cam;
  const std::vector<Localisation> answers = AnswersOf(localiser, drives);
  EXPECT_GE(CountFound(answers), 5);
  for (const Localisation& answer : answers) {
    if (answer.decision != LoopDecision::kAccepted) continue;
    const auto at = static_cast<std::size_t>(answer.frame);
    const Vec6 error =
        ((T_new_old * drives.world.truth.poses[at]).inverse() * answer.T_map_cam).Log();
    EXPECT_LT(error.head<3>().norm(), 1.5) << answer.frame;
    EXPECT_LT(error.tail<3>().norm(), 0.06) << answer.frame;
    const Pose& T_odom_cam = drives.frames[at].T_odom_cam;
    EXPECT_LT((answer.T_map_cam.inverse() * answer.T_map_odom * T_odom_cam).Log().norm(), 1e-9);
  }
}

TEST(Localiser, SaysWhyNot) {
  Localiser elsewhere(TrueMap(BlockWorld(3)), {});
  const std::vector<Localisation> answers = AnswersOf(elsewhere, Stretch(BlockWorld(4), 20, 200));
  EXPECT_GT(answers.size(), 20u);
  EXPECT_EQ(CountFound(answers), 0);
  for (const Localisation& answer : answers) EXPECT_FALSE(answer.reason.empty());

  Localiser empty(TrueMap(BlockWorld(3)), {});
  sim::World bare = EmptyWorld();
  for (const Localisation& answer : AnswersOf(empty, Stretch(bare, 20, 60))) {
    EXPECT_EQ(answer.decision, LoopDecision::kNone);
    EXPECT_EQ(answer.reason, "0 objects are too few: 4 have to agree");
    EXPECT_TRUE(answer.pairs.empty());
  }
}

// Two equal blocks in one map: nothing tells which one it is.
TEST(Localiser, DoesNotChooseBetweenCopies) {
  const sim::World world = BlockWorld(3);
  ReferenceMap map = TrueMap(world);
  const std::size_t count = map.objects.size();
  for (std::size_t i = 0; i < count; ++i) {
    map.objects.push_back(map.objects[i]);
    map.objects.back().id += 1000;
    map.objects.back().position.x() += 500;
  }
  Localiser localiser(map, {});
  const std::vector<Localisation> answers = AnswersOf(localiser, Stretch(world, 20, 150));
  EXPECT_EQ(CountFound(answers), 0);
  EXPECT_EQ(answers.back().decision, LoopDecision::kAmbiguous);
}

// The robot has not moved far enough for an attempt on its own.
TEST(Localiser, AnswersWhenAsked) {
  const sim::World world = BlockWorld(3);
  Localiser localiser(TrueMap(world), {});
  EXPECT_EQ(ErrorOf([&] { localiser.Attempt(); }), "there is no frame to localise yet");
  const Drives drives = Stretch(world, 30, 60);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_FALSE(localiser.AddFrame(drives.frames[i]));
  const Localisation answer = localiser.Attempt();
  EXPECT_EQ(answer.frame, drives.frames[3].index);
  EXPECT_FALSE(answer.reason.empty());
}

// Odometry in half metres.
TEST(Localiser, TakesTheScaleOfTheMap) {
  const sim::World world = BlockWorld(3);
  ReferenceMap map = TrueMap(world);
  map.scale = 0.5;
  Localiser localiser(map, {});
  Drives drives = Stretch(world, 20, 120);
  for (Frame& frame : drives.frames)
    frame.T_odom_cam = Pose(frame.T_odom_cam.so3(), Vec3(2 * frame.T_odom_cam.translation()));
  EXPECT_GE(CountFound(AnswersOf(localiser, drives)), 5);
}

TEST(Localiser, RefusesMapsThatAreNone) {
  const ReferenceMap good = TrueMap(BlockWorld(3));
  const auto problem = [&](const std::function<void(ReferenceMap&)>& spoil) {
    ReferenceMap map = good;
    spoil(map);
    return ErrorOf([&] { Localiser(map, Options()); });
  };
  EXPECT_EQ(problem([](ReferenceMap& map) { map.objects.clear(); }),
            "the map to localise in has no objects; map a drive first");
  EXPECT_EQ(problem([](ReferenceMap& map) { map.objects[1].id = map.objects[0].id; }),
            "the map to localise in has two objects with the id 100");
  EXPECT_EQ(problem([](ReferenceMap& map) { map.objects[0].label = 2; }),
            "the map to localise in has no name for the label of object 100");
  EXPECT_EQ(problem([](ReferenceMap& map) { map.objects[0].altitude = NAN; }),
            "the map to localise in has no finite position of object 100");
  EXPECT_EQ(problem([](ReferenceMap& map) { map.scale = 0; }),
            "the map to localise in has no scale above 0");
}

}  // namespace
}  // namespace sslcd
