// SPDX-License-Identifier: BSD-3-Clause
// Loop closure on real sequences, held to its figures (docs/results.md): one configuration for all. Skipped where the
// data is not there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "sslcd/eval/kitti_ground_truth.h"
#include "sslcd/eval/sequence_metrics.h"
#include "sslcd/io/dataset.h"
#include "sslcd/pipeline/run.h"

namespace sslcd {
namespace {

struct Bar {
  const char* sequence;
  const char* groundtruth;
  double ate_m, recall;
  double per_object, purity;  // landmarks per true one; infinite and 0: no bar
  bool opposite;              // loops from the opposite direction
};

std::ostream& operator<<(std::ostream& out, const Bar& bar) { return out << bar.sequence; }

class RealLoops : public ::testing::TestWithParam<Bar> {};

TEST_P(RealLoops, ReachTheirFigures) {
  const Bar& bar = GetParam();
  const char* root = std::getenv("SSLCD_DATA_DIR");
  const std::string data = std::string(root ? root : "../shared/data") + "/" + bar.sequence;
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "skipped: no data at " << data << " (SSLCD_DATA_DIR)";

  DatasetRequest request;
  request.path = data;
  request.format = DatasetFormat::kSequence;
  request.groundtruth = bar.groundtruth;
  const Dataset dataset = LoadDataset(request);
  const RunResult result =
      RunSequence(dataset.frames, {GravityFrame::FromUp(dataset.up_axis), dataset.labels, dataset.camera}, {});

  SequenceRun run;
  run.estimate = result.trajectory.poses;
  run.odometry = result.odometry.poses;
  run.reference = dataset.groundtruth->poses;
  run.frames = dataset.frames;
  run.identities = ReadLandmarkIds(data + "/landmark_ids.txt");
  run.loops = result.loops;
  run.objects = result.objects;
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_LE(metrics.ate, bar.ate_m) << "odometry: " << metrics.ate_odometry;
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_GE(metrics.recall, bar.recall);
  EXPECT_LE(metrics.landmarks_per_true, bar.per_object);
  EXPECT_GE(metrics.purity, bar.purity);
  if (bar.opposite) {
    EXPECT_GT(metrics.true_by_viewpoint.back(), 0);
  }
  RecordProperty("ate_m", std::to_string(metrics.ate));
  RecordProperty("recall", std::to_string(metrics.recall));
  RecordProperty("purity", std::to_string(metrics.purity));
}

INSTANTIATE_TEST_SUITE_P(VictoriaPark, RealLoops,
                         ::testing::Values(Bar{"victoria-park", "reference.txt", 4., .70, 1.15, .965, true}));
constexpr double kNoBar = std::numeric_limits<double>::infinity();
// ATE: that of a plain solver fed with true loops.
INSTANTIATE_TEST_SUITE_P(
    KittiOdometryPoles, RealLoops,
    ::testing::Values(Bar{"kitti-odometry-poles/00", "groundtruth.txt", 7.3, .60, kNoBar, 0, false},
                      Bar{"kitti-odometry-poles/02", "groundtruth.txt", 10.6, .60, kNoBar, 0, false},
                      Bar{"kitti-odometry-poles/05", "groundtruth.txt", 7.0, .60, kNoBar, 0, false}));

}  // namespace
}  // namespace sslcd
