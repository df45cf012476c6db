// SPDX-License-Identifier: BSD-3-Clause
// Loop closure on real sequences, held to docs/figures.json: one configuration for all.
// Skipped where the data is not there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "eval/kitti_ground_truth.h"
#include "eval/sequence_metrics.h"
#include "figures.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/run.h"

namespace sslcd {
namespace {

struct Sequence {
  const char* folder;
  const char* groundtruth;
};

std::ostream& operator<<(std::ostream& out, const Sequence& sequence) {
  return out << sequence.folder;
}

class RealLoops : public ::testing::TestWithParam<Sequence> {};

TEST_P(RealLoops, KeepTheirFigures) {
  const Sequence& sequence = GetParam();
  const char* root = std::getenv("SSLCD_DATA_DIR");
  const std::string data = std::string(root ? root : "../shared/data") + "/" + sequence.folder;
  if (!std::filesystem::is_directory(data))
    GTEST_SKIP() << "skipped: no data at " << data << " (SSLCD_DATA_DIR)";

  DatasetRequest request;
  request.path = data;
  request.format = "sequence";
  request.groundtruth = sequence.groundtruth;
  const Dataset dataset = LoadDataset(request);
  const RunResult result = RunSequence(
      dataset.frames, {GravityFrame::FromUp(dataset.up_axis), dataset.labels, dataset.camera}, {});

  SequenceRun run;
  run.estimate = result.trajectory.poses;
  run.odometry = result.odometry.poses;
  run.reference = dataset.groundtruth->poses;
  run.frames = dataset.frames;
  run.identities = ReadLandmarkIds(data + "/landmark_ids.txt");
  run.loops = result.loops;
  run.objects = result.objects;
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);

  const Figures figures(std::string("loops/") + sequence.folder);
  figures.ExpectSimilar("odometry_ate_se3_rmse_m", metrics.ate_odometry);
  figures.ExpectSimilar("ate_se3_rmse_m", metrics.ate);
  figures.ExpectSimilar("loops", metrics.loops);
  figures.ExpectSame("loops_wrong", metrics.wrong_loops);
  figures.ExpectSimilar("loop_error_median_m", *metrics.loop_error_median_m);
  figures.ExpectSimilar("landmarks", metrics.landmarks);
  figures.ExpectSame("revisited_stretches", metrics.revisited_stretches);
  figures.ExpectShare("revisits_recognised", metrics.recall, 1. / metrics.revisited_stretches);
  figures.ExpectShare("purity", metrics.purity);
}

INSTANTIATE_TEST_SUITE_P(Sequences, RealLoops,
                         ::testing::Values(Sequence{"victoria-park", "reference.txt"},
                                           Sequence{"kitti-odometry-poles/00", "groundtruth.txt"},
                                           Sequence{"kitti-odometry-poles/02", "groundtruth.txt"},
                                           Sequence{"kitti-odometry-poles/05", "groundtruth.txt"},
                                           Sequence{"forest-evo-fwd", "groundtruth.txt"},
                                           Sequence{"forest-venman3-fwd", "groundtruth.txt"}));

}  // namespace
}  // namespace sslcd
