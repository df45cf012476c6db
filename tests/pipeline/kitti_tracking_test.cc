// SPDX-License-Identifier: BSD-3-Clause
// The main job on real data, held to its figures (docs/results.md). Skipped where the data is not
// there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "sslcd/eval/map_metrics.h"
#include "sslcd/eval/trajectory_error.h"
#include "sslcd/io/dataset.h"
#include "sslcd/pipeline/run.h"

namespace sslcd {
namespace {

struct Bar {
  const char* sequence;
  const char* detections;
  double ate_m;  // 0: no true poses
  double iou, coverage, purity, found, per_object, driving;
};

std::ostream& operator<<(std::ostream& out, const Bar& bar) {
  return out << bar.sequence << " " << bar.detections;
}

class KittiTracking : public ::testing::TestWithParam<Bar> {};

TEST_P(KittiTracking, ReachesItsFigures) {
  const Bar& bar = GetParam();
  const char* root = std::getenv("SSLCD_DATA_DIR");
  const std::string data = std::string(root ? root : "../shared/data") + "/kitti-tracking";
  if (!std::filesystem::is_directory(data))
    GTEST_SKIP() << "skipped: no data at " << data << " (SSLCD_DATA_DIR)";

  DatasetRequest request;
  request.path = data;
  request.format = DatasetFormat::kKittiTracking;
  request.sequence = bar.sequence;
  request.detections = bar.detections;
  request.odometry = "orbslam3_poses";
  if (bar.ate_m > 0) request.groundtruth = "oxts_cam0_poses";
  const Dataset dataset = LoadDataset(request);
  const RunResult result = RunSequence(
      dataset.frames, {GravityFrame::FromUp(dataset.up_axis), dataset.labels, dataset.camera}, {});

  MapRun run;
  run.estimate = result.trajectory.poses;
  run.objects = result.objects;
  run.frames = dataset.frames;
  run.reference =
      dataset.groundtruth ? dataset.groundtruth->poses : ScaledPath(result.odometry.poses, 0.975);
  run.truth = ReadKittiTrackingLabels(data + "/label_02/" + bar.sequence + ".txt");
  const MapMetrics metrics = ComputeMapMetrics(run);
  if (dataset.groundtruth) {
    EXPECT_LE(ComputeAte(run.estimate, run.reference).error.rmse, bar.ate_m);
  }
  EXPECT_GE(*metrics.iou_map, bar.iou);
  EXPECT_GE(metrics.coverage, bar.coverage);
  EXPECT_GE(metrics.purity, bar.purity);
  EXPECT_GE(metrics.static_found, bar.found);
  EXPECT_LE(metrics.landmarks_per_static, bar.per_object);
  EXPECT_LE(metrics.driving_in_map, bar.driving);
}

constexpr char kLidar[] = "det_pointrcnn_car", kStereo[] = "det_stereo_grade_car";
INSTANTIATE_TEST_SUITE_P(
    RealDetections, KittiTracking,
    ::testing::Values(Bar{"0007", kLidar, 1.30, .822, .97, .98, .97, 1.10, .05},
                      Bar{"0009", kLidar, 1.00, .820, .97, .98, .97, 1.10, .05},
                      Bar{"0011", kLidar, 0, .838, .97, .98, .97, 1.10, .05},
                      Bar{"0001", kLidar, .65, .830, .97, .98, .97, 1.10, .05},
                      Bar{"0005", kLidar, 1.00, .75, .97, .98, .97, 1.10, .05}));
INSTANTIATE_TEST_SUITE_P(
    StereoGrade, KittiTracking,
    ::testing::Values(Bar{"0007", kStereo, 1.30, .60, .88, .95, .90, 1.25, .10},
                      Bar{"0009", kStereo, 5.31, .45, .76, .95, .90, 1.25, .10},
                      Bar{"0011", kStereo, 0, .52, .80, .95, .90, 1.25, .10}));

}  // namespace
}  // namespace sslcd
