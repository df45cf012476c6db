// SPDX-License-Identifier: BSD-3-Clause
#include "eval/map_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sigmoid.h"
#include "sslcd/core/error.h"
#include "sslcd/core/pose.h"

namespace sslcd {
namespace {

const GravityFrame kCamera;
const Vec3 kDims(4, 2, 1.5);

/// Ten frames, a camera that drives along z at 1 m a frame; track 1 is parked, track 2 drives ahead
/// of the camera. Detections are perfect: row 2 f sees track 1, row 2 f + 1 sees track 2. The map
/// has the parked car.
MapRun SmallRun() {
  MapRun run;
  MapObject parked;
  parked.id = {1};
  parked.label = "Car";
  parked.state = LandmarkState::kConfirmed;
  parked.T_world_object = ToPose({Vec3(3, 1, 30), 0.3}, kCamera);
  parked.dims = kDims;
  for (int f = 0; f < 10; ++f) {
    const Pose T_world_cam = Pose::Trans(0, 0, f);
    run.estimate.push_back(T_world_cam);
    run.reference.push_back(T_world_cam);
    const Pose T_cam_parked = T_world_cam.inverse() * parked.T_world_object;
    const Pose T_cam_driving = ToPose({Vec3(-2, 1, 12), M_PI / 2}, kCamera);
    run.truth.push_back({f, 1, "Car", T_cam_parked, kDims});
    run.truth.push_back({f, 2, "Van", T_cam_driving, kDims});
    run.truth.push_back({f, 3, "Pedestrian", T_cam_driving, kDims});
    Frame frame;
    frame.index = f;
    for (const Pose& T : {T_cam_parked, T_cam_driving}) {
      Detection detection;
      detection.row = 2 * f + static_cast<int>(frame.detections.size());
      detection.T_cam_object = T;
      detection.dims = kDims;
      detection.score = 0.96;
      frame.detections.push_back(detection);
    }
    run.frames.push_back(frame);
    parked.observations.push_back({f, 2 * f});
  }
  run.objects.push_back(parked);
  return run;
}

TEST(MapMetricsTest, APerfectMap) {
  const MapMetrics metrics = ComputeMapMetrics(SmallRun());
  EXPECT_EQ(metrics.pairs, 10);
  EXPECT_NEAR(metrics.iou_raw.value(), 1, 1e-9);
  EXPECT_NEAR(metrics.iou_map.value(), 1, 1e-9);
  EXPECT_NEAR(metrics.iou_raw_same_pairs.value(), 1, 1e-9);
  EXPECT_EQ(metrics.coverage, 1);
  EXPECT_EQ(metrics.landmarks, 1);
  EXPECT_EQ(metrics.purity, 1);
  EXPECT_EQ(metrics.static_objects, 1);
  EXPECT_EQ(metrics.static_found, 1);
  EXPECT_EQ(metrics.landmarks_per_static, 1);
  EXPECT_EQ(metrics.driving_in_map, 0);
}

TEST(MapMetricsTest, MistakesShow) {
  MapRun run = SmallRun();
  run.objects[0].T_world_object.translation().z() += 0.5;  // half a metre off
  run.objects[0].observations.resize(8);                   // and lost in the last two frames
  run.objects[0].observations.push_back({3, 7});           // one observation of the wrong car
  MapObject twin = SmallRun().objects[0], driving = twin, tentative = twin;
  twin.observations = {{8, 16}};
  driving.observations = {{4, 9}, {5, 11}, {6, 12}};
  tentative.state = LandmarkState::kTentative;
  run.objects.insert(run.objects.end(), {twin, driving, tentative});
  const MapMetrics metrics = ComputeMapMetrics(run);
  EXPECT_NEAR(metrics.iou_raw.value(), 1, 1e-9);
  EXPECT_EQ(metrics.landmarks, 3);
  EXPECT_DOUBLE_EQ(metrics.purity, 11. / 13);
  EXPECT_DOUBLE_EQ(metrics.coverage, 0.9);  // frame 9 has no observation
  EXPECT_LT(metrics.iou_map.value(), 0.95);
  EXPECT_EQ(metrics.static_found, 1);
  EXPECT_EQ(metrics.landmarks_per_static, 2);
  EXPECT_EQ(metrics.driving_in_map, 1);
}

TEST(MapMetricsTest, TheScoreThresholdIsAProbability) {
  EXPECT_DOUBLE_EQ(Sigmoid(3), MapMetricOptions().min_score);
  EXPECT_DOUBLE_EQ(Sigmoid(0), 0.5);
  MapRun run = SmallRun();
  for (Frame& frame : run.frames) frame.detections[0].score = 0.95;
  MapMetrics metrics = ComputeMapMetrics(run);
  EXPECT_EQ(metrics.pairs, 0);
  EXPECT_EQ(metrics.static_objects, 0);
  EXPECT_EQ(metrics.purity, 1);  // identities do not depend on the score
  MapMetricOptions options;
  options.min_score = 0.9;
  EXPECT_EQ(ComputeMapMetrics(run, options).pairs, 10);
}

TEST(MapMetricsTest, ShorterTrajectories) {
  MapRun run = SmallRun();
  run.estimate.resize(4);
  EXPECT_EQ(ComputeMapMetrics(run).pairs, 4);
  run.estimate.clear();
  EXPECT_EQ(ComputeMapMetrics(run).pairs, 0);
  run = SmallRun();
  run.reference.resize(3);  // too short to see the van move far: it extends 2 m
  EXPECT_EQ(ComputeMapMetrics(run).static_objects, 1);
  run.reference.resize(2);
  EXPECT_EQ(ComputeMapMetrics(run).static_objects, 2);
}

TEST(MapMetricsTest, NothingToJudge) {
  for (const MapMetrics& metrics : {ComputeMapMetrics({}), [] {
                                      MapRun run = SmallRun();
                                      run.truth.clear();
                                      return ComputeMapMetrics(run);
                                    }()}) {
    EXPECT_FALSE(metrics.iou_raw.has_value());
    EXPECT_FALSE(metrics.iou_map.has_value());
    EXPECT_FALSE(metrics.iou_raw_same_pairs.has_value());
    EXPECT_EQ(metrics.coverage, 0);
    EXPECT_EQ(metrics.purity, 0);
    EXPECT_EQ(metrics.static_found, 0);
    EXPECT_EQ(metrics.landmarks_per_static, 0);
  }
  MapRun no_map = SmallRun();
  no_map.objects.clear();
  const MapMetrics metrics = ComputeMapMetrics(no_map);
  EXPECT_EQ(metrics.pairs, 10);
  EXPECT_FALSE(metrics.iou_map.has_value());
  EXPECT_EQ(metrics.landmarks, 0);
}

TEST(MapMetricsTest, BadNumbersAreErrors) {
  MapRun twice = SmallRun();
  twice.frames[3].index = 2;
  EXPECT_THROW(ComputeMapMetrics(twice), Error);
  MapRun negative = SmallRun();
  negative.truth[0].frame = -1;
  EXPECT_THROW(ComputeMapMetrics(negative), Error);
}

}  // namespace
}  // namespace sslcd
