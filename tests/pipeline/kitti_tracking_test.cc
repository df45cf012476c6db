// SPDX-License-Identifier: BSD-3-Clause
// The map on KITTI tracking, where there are true poses (not for 0011), held to docs/figures.json.
// Skipped where the data is not there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "eval/map_metrics.h"
#include "figures.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/eval/trajectory_error.h"
#include "sslcd/pipeline/run.h"

namespace sslcd {
namespace {

struct Sequence {
  const char* number;
  const char* detections;
};

std::ostream& operator<<(std::ostream& out, const Sequence& sequence) {
  return out << sequence.number << " " << sequence.detections;
}

class KittiTracking : public ::testing::TestWithParam<Sequence> {};

TEST_P(KittiTracking, KeepsItsFigures) {
  const Sequence& sequence = GetParam();
  const char* root = std::getenv("SSLCD_DATA_DIR");
  const std::string data = std::string(root ? root : "../shared/data") + "/kitti-tracking";
  if (!std::filesystem::is_directory(data))
    GTEST_SKIP() << "skipped: no data at " << data << " (SSLCD_DATA_DIR)";

  DatasetRequest request;
  request.path = data;
  request.format = "kitti-tracking";
  request.sequence = sequence.number;
  request.detections = sequence.detections;
  request.odometry = "orbslam3_poses";
  request.groundtruth = "oxts_cam0_poses";
  const Dataset dataset = LoadDataset(request);
  const RunResult result = RunSequence(
      dataset.frames, {GravityFrame::FromUp(dataset.up_axis), dataset.labels, dataset.camera}, {});

  MapRun run;
  run.estimate = result.trajectory.poses;
  run.objects = result.objects;
  run.frames = dataset.frames;
  run.reference = dataset.groundtruth->poses;
  run.truth = ReadKittiTrackingLabels(data + "/label_02/" + sequence.number + ".txt");
  const MapMetrics metrics = ComputeMapMetrics(run);

  const Figures figures(std::string("kitti/") + sequence.detections + "/" + sequence.number);
  const auto ate = [&](Alignment alignment) {
    return ComputeAte(run.estimate, run.reference, alignment).error.rmse;
  };
  figures.ExpectSimilar("ate_se3_rmse_m", ate(Alignment::kSe3));
  figures.ExpectSimilar("ate_sim3_rmse_m", ate(Alignment::kSim3));
  figures.ExpectSame("static_objects", metrics.static_objects);
  figures.ExpectSame("iou_pairs", metrics.pairs);
  figures.ExpectGain("iou_raw", "iou_map", *metrics.iou_map);
  figures.ExpectShare("coverage", metrics.coverage);
  figures.ExpectShare("purity", metrics.purity);
  figures.ExpectShare("static_found", metrics.static_found, 1. / metrics.static_objects);
  figures.ExpectSimilar("landmarks_per_static", metrics.landmarks_per_static);
  // The driving cars are few: a single one in the map of a sequence that had none is a fault.
  EXPECT_LE(metrics.driving_in_map, figures.Get("driving_in_map") + 1e-6);
}

constexpr char kLidar[] = "det_pointrcnn_car", kStereo[] = "det_stereo_grade_car";
INSTANTIATE_TEST_SUITE_P(Lidar, KittiTracking,
                         ::testing::Values(Sequence{"0001", kLidar}, Sequence{"0005", kLidar},
                                           Sequence{"0007", kLidar}, Sequence{"0009", kLidar}));
INSTANTIATE_TEST_SUITE_P(StereoGrade, KittiTracking,
                         ::testing::Values(Sequence{"0007", kStereo}, Sequence{"0009", kStereo}));

}  // namespace
}  // namespace sslcd
