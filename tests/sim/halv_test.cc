// SPDX-License-Identifier: BSD-3-Clause
#include "sim/halv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "eval/iou3d.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/trajectory_error.h"
#include "temp_folder.h"

namespace sslcd::sim {
namespace {

HalvScene Case(int number) {
  HalvScene scene;
  scene.case_number = number;
  return scene;
}

bool IsVehicle(const WorldObject& object) {
  return object.label == "Car" || object.label == "Van" || object.label == "Truck";
}

TEST(HalvWorld, IsSane) {
  for (const char* layout : {"lot", "street"}) {
    for (int number = 1; number <= 4; ++number) {
      HalvScene scene = Case(number);
      scene.layout = layout;
      const World world = MakeHalvWorld(number, scene).world;
      EXPECT_NEAR(world.truth.poses[0].Log().norm(), 0, 1e-12);
      EXPECT_NEAR(world.truth.stamps[3], 1, 1e-12);  // 3 Hz
      EXPECT_NEAR(2 * std::atan(640 / world.camera.fx) * 180 / M_PI, 110, 1e-9);
      EXPECT_NEAR(2 * std::atan(360 / world.camera.fy) * 180 / M_PI, 70, 1e-9);
      EXPECT_EQ(world.baseline_m, 0.12);
      std::set<std::string> labels;
      for (const WorldObject& object : world.objects) {
        labels.insert(object.label);
        for (const Pose& pose : object.T_world_object)
          EXPECT_NEAR(pose.translation().y() + 0.5 * object.dims.z(), world.camera_height_m,
                      1e-9);  // on the ground
      }
      for (const char* label : {"Car", "Pole", "Tree"}) EXPECT_TRUE(labels.count(label)) << label;
    }
  }
}

TEST(HalvWorld, NobodyIsRunOverAndNobodyOverlaps) {
  for (int number = 1; number <= 4; ++number) {
    const World world = MakeHalvWorld(7, Case(number)).world;
    std::vector<Cuboid> parked;
    for (const WorldObject& object : world.objects) {
      if (object.driving() || !IsVehicle(object)) continue;
      const Cuboid cuboid = ToCuboid(object.PoseAt(0), object.dims, world.gravity);
      for (const Cuboid& other : parked) {
        if (HorizontalDistance(cuboid, other) < 8) {
          EXPECT_EQ(FootprintIntersection(cuboid, other), 0);
        }
      }
      parked.push_back(cuboid);
      for (const Pose& camera : world.truth.poses) {
        const Vec3 there = object.PoseAt(0).inverse() * camera.translation();
        EXPECT_TRUE(std::abs(there.x()) > 0.5 * object.dims.x() + 0.3 ||
                    std::abs(there.y()) > 0.5 * object.dims.y() + 0.3)
            << number;
      }
    }
  }
}

TEST(HalvWorld, SixtyPercentOfTheStallsAreTaken) {
  HalvScene full = Case(1), usual = Case(1);
  full.taken_fraction = 1;
  const auto parked = [](const World& world) {
    return std::count_if(world.objects.begin(), world.objects.end(), [](const WorldObject& object) {
      return IsVehicle(object) && !object.driving();
    });
  };
  const double stalls = static_cast<double>(parked(MakeHalvWorld(1, full).world));
  EXPECT_NEAR(static_cast<double>(parked(MakeHalvWorld(1, usual).world)) / stalls, 0.6, 0.06);
}

/// In every case many objects of the way out are detected again, and those of the paper's cases
/// from other sides.
TEST(Halv, RevisitsAreRealAndFromOtherDirections) {
  for (int number = 1; number <= 4; ++number) {
    HalvOptions options;
    options.scene = Case(number);
    const HalvSequence sequence = MakeHalv(2, options);
    const int frames = static_cast<int>(sequence.detections.frames.size());
    const int last_leg = frames - frames / 5;
    std::vector<std::set<int>> seen(2);
    for (int frame = 0; frame < frames; ++frame) {
      if (frame > sequence.scene.return_frame && frame < last_leg) continue;
      for (const Detection& detection : sequence.detections.frames[frame])
        seen[frame >= last_leg].insert(sequence.detections.identity[detection.row]);
    }
    std::vector<int> common;
    std::set_intersection(seen[0].begin(), seen[0].end(), seen[1].begin(), seen[1].end(),
                          std::back_inserter(common));
    EXPECT_GE(common.size(), 12u) << "case " << number;

    const double degrees = sequence.scene.viewpoint_rad * 180 / M_PI;
    const double low[] = {60, 170, 120, 0}, high[] = {120, 180, 170, 45};
    EXPECT_GE(degrees, low[number - 1]);
    EXPECT_LE(degrees, high[number - 1]);
  }
}

TEST(Halv, SameSeedSameSequence) {
  const HalvSequence a = MakeHalv(5), b = MakeHalv(5), c = MakeHalv(6);
  EXPECT_EQ(a.detections.identity, b.detections.identity);
  EXPECT_EQ(a.detections.frames[9][0].appearance[Cue::kEmbedding],
            b.detections.frames[9][0].appearance[Cue::kEmbedding]);
  EXPECT_EQ(a.odometry.poses.back().translation(), b.odometry.poses.back().translation());
  EXPECT_NE(a.detections.identity, c.detections.identity);
}

TEST(Halv, AVisitSeesTheSameWorldWithOtherNoise) {
  HalvOptions options;
  options.drift.ate_m = 0;
  const HalvSequence first = MakeHalv(5, options);
  options.visit = 1;
  const HalvSequence second = MakeHalv(5, options);
  const World &a = first.scene.world, &b = second.scene.world;
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i)
    EXPECT_EQ(a.objects[i].T_world_object[0].matrix(), b.objects[i].T_world_object[0].matrix());
  ASSERT_EQ(a.truth.size(), b.truth.size());
  EXPECT_EQ(a.truth.poses.back().matrix(), b.truth.poses.back().matrix());
  EXPECT_NE(first.odometry.poses.back().matrix(), second.odometry.poses.back().matrix());
  EXPECT_NE(first.detections.identity, second.detections.identity);
  options.visit = -1;
  ExpectError([&] { MakeHalv(5, options); }, {"visit"});
}

TEST(Halv, RowsTellNothingButTheirScores) {
  const HalvSequence sequence = MakeHalv(5);
  int row = 0, in_order = 0, pairs = 0;
  for (std::size_t frame = 0; frame < sequence.detections.frames.size(); ++frame) {
    const std::vector<Detection>& detections = sequence.detections.frames[frame];
    for (std::size_t i = 0; i < detections.size(); ++i) {
      ASSERT_EQ(detections[i].row, row);
      const int id = sequence.detections.identity[row++];
      if (i > 0) {
        EXPECT_LE(detections[i].score, detections[i - 1].score);
        ++pairs;
        in_order += id > sequence.detections.identity[row - 2];
      }
      if (id < 0) continue;  // its true object is at the detected place
      const Vec3 seen =
          sequence.scene.world.truth.poses[frame] * detections[i].T_cam_object.translation();
      EXPECT_LT(
          (seen - sequence.scene.world.objects[id].PoseAt(static_cast<int>(frame)).translation())
              .norm(),
          8);
    }
  }
  EXPECT_NEAR(static_cast<double>(in_order) / pairs, 0.5, 0.1);
}

TEST(Halv, ChurnReplacesThatShareOfTheVehicles) {
  HalvScene scene = Case(2);
  scene.churn = 0.3;
  scene.driving_cars = 0;
  const HalvWorld halv = MakeHalvWorld(3, scene);
  const HalvWorld calm = MakeHalvWorld(3, [&] {
    auto s = scene;
    s.churn = 0;
    return s;
  }());
  const int last = static_cast<int>(halv.world.truth.size()) - 1;
  int before = 0, after = 0, stayed = 0;
  for (const WorldObject& object : halv.world.objects) {
    if (!IsVehicle(object)) continue;
    before += object.IsThereAt(0);
    after += object.IsThereAt(last);
    stayed += object.IsThereAt(0) && object.IsThereAt(last);
  }
  EXPECT_EQ(before, after);
  EXPECT_NEAR(1 - static_cast<double>(stayed) / before, 0.3, 0.5 / before + 1e-9);
  ASSERT_LT(calm.world.objects.size(), halv.world.objects.size());
  for (const WorldObject& object : calm.world.objects) {  // nothing else has changed
    EXPECT_EQ(object.PoseAt(0).translation(),
              halv.world.objects[object.id].PoseAt(0).translation());
  }

  // What has gone is not detected any more, what comes not before.
  const SimulatedDetections detections = SimulateDetections(halv.world, HalvDetector(), 3);
  for (int frame = 0; frame <= last; ++frame) {
    for (const Detection& detection : detections.frames[frame]) {
      const int id = detections.identity[detection.row];
      if (id >= 0) {
        EXPECT_TRUE(halv.world.objects[id].IsThereAt(frame));
      }
    }
  }
}

TEST(Halv, VehiclesAreReplacedAgainAndAgain) {
  HalvScene scene = Case(2);
  scene.driving_cars = 0;
  HalvWorld halv = MakeHalvWorld(3, scene);
  const int frames = static_cast<int>(halv.world.truth.size());
  scene.churn = 0.3;
  for (const int change : {1, 2}) ReplaceVehicles(scene, change, change * frames, halv);
  const auto there = [&](int session, const WorldObject& object) {
    return IsVehicle(object) && object.IsThereAt(session * frames);
  };
  const std::vector<WorldObject>& objects = halv.world.objects;
  for (const int change : {1, 2}) {
    int before = 0, after = 0, stayed = 0;
    for (const WorldObject& object : objects) {
      before += there(change - 1, object);
      after += there(change, object);
      stayed += there(change - 1, object) && there(change, object);
      if (!there(change, object)) continue;
      for (const WorldObject& other : objects) {  // each has a space of its own
        const double apart =
            (other.PoseAt(0).translation() - object.PoseAt(0).translation()).norm();
        EXPECT_TRUE(!there(change, other) || other.id == object.id || apart > 1.5);
      }
    }
    EXPECT_EQ(before, after);
    EXPECT_NEAR(1 - static_cast<double>(stayed) / before, 0.3, 0.5 / before + 1e-9);
  }
}

TEST(Halv, DriftIsAsLargeAsTold) {
  const Trajectory truth = MakeHalvWorld(1, Case(2)).world.truth;
  for (double ate : {0.3, 2.}) {
    const CalibratedOdometry result =
        SimulateOdometryWithAte(truth, HalvDrift().shape, ate, 0.15, 4);
    const double reached =
        ComputeAte(result.odometry.poses, truth.poses, Alignment::kSim3).error.rmse;
    EXPECT_NEAR(reached, ate, 0.19 * ate);
  }
  HalvOptions options;
  options.drift.ate_m = 0;
  options.drift.shape = {0, 0, 0, 0, 0, 0, 1};
  const HalvSequence perfect = MakeHalv(1, options);
  EXPECT_LT((perfect.odometry.poses.back().inverse() * perfect.scene.world.truth.poses.back())
                .Log()
                .norm(),
            1e-9);
}

TEST(Halv, BadOptionsSayWhatToDo) {
  const auto refuse = [](auto change, const std::vector<std::string>& parts) {
    HalvOptions options;
    change(options);
    ExpectError([&] { MakeHalv(1, options); }, parts);
  };
  refuse([](auto& o) { o.scene.case_number = 5; }, {"case is 5", "1 to 4"});
  refuse([](auto& o) { o.scene.taken_fraction = 0; }, {"no cars", "--taken-fraction"});
  refuse([](auto& o) { o.scene.churn = 1.1; }, {"churn is 1.1", "0 to 1"});
  refuse([](auto& o) { o.detector.flip_rate = -0.1; }, {"flip_rate is -0.1"});
  refuse([](auto& o) { o.detector.sigmas.radial_m = -1; }, {"radial_m is -1"});
  refuse([](auto& o) { o.drift.shape.wander_scale = -1; }, {"wander_scale is -1"});
  refuse([](auto& o) { o.appearance.light = std::nan(""); }, {"light is nan"});
  refuse([](auto& o) { o.appearance.same_side = 0.2; }, {"same_side", "opposite_side"});
  refuse(
      [](auto& o) {
        o.scene.viewpoint_low_deg = 90;
        o.scene.viewpoint_high_deg = 10;
      },
      {"viewpoint_low_deg"});
  refuse([](auto& o) { o.drift.shape = {0, 0, 0, 0, 0, 0, 1}; }, {"--ate-m"});
  refuse([](auto& o) { o.drift.ate_m = -0.5; }, {"ate_m", "0 or more", "-1"});
  refuse([](auto& o) { o.scene.viewpoint_low_deg = -0.5; }, {"viewpoint_low_deg", "-1"});
  ExpectError([] { HalvAte(7); }, {"case is 7", "1 to 4"});
  refuse([](auto& o) { o.scene.layout = "/nowhere.json"; }, {"/nowhere.json"});
}

}  // namespace
}  // namespace sslcd::sim
