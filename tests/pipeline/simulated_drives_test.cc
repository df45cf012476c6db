// SPDX-License-Identifier: BSD-3-Clause
// Loop closure on the simulated drives of tests/data, which every copy of the repository has. The
// estimator is not told the truth: it is read here, and only to judge.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "eval/kitti_ground_truth.h"
#include "eval/sequence_metrics.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/run.h"

namespace sslcd {
namespace {

// As measured. [m]
struct Drive {
  const char* folder;
  double odometry_ate_m, ate_m;
  int loops, opposite_loops;  // of them from 135 degrees on
};

std::ostream& operator<<(std::ostream& out, const Drive& drive) { return out << drive.folder; }

class SimulatedDrives : public ::testing::TestWithParam<Drive> {};

TEST_P(SimulatedDrives, LoopsAreFoundAndNoneIsWrong) {
  constexpr double kTolerance = 1.15;  // for other processors and libraries
  const Drive& drive = GetParam();
  const std::filesystem::path folder =
      std::filesystem::path(__FILE__).parent_path() / "../data" / drive.folder;
  DatasetRequest request;
  request.path = folder.string();
  const Dataset dataset = LoadDataset(request);
  const RunResult result = RunSequence(
      dataset.frames, {GravityFrame::FromUp(dataset.up_axis), dataset.labels, dataset.camera}, {});

  SequenceRun run;
  run.estimate = result.trajectory.poses;
  run.odometry = result.odometry.poses;
  run.reference = dataset.groundtruth->poses;
  run.frames = dataset.frames;
  run.identities = ReadLandmarkIds((folder / "landmark_ids.txt").string());
  run.loops = result.loops;
  run.objects = result.objects;
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_NEAR(metrics.ate_odometry, drive.odometry_ate_m, 1e-3) << "the data is another";
  EXPECT_LE(metrics.ate, kTolerance * drive.ate_m);
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_GE(metrics.loops, drive.loops / kTolerance);
  EXPECT_GE(metrics.true_by_viewpoint.back(), drive.opposite_loops / kTolerance);
}

INSTANTIATE_TEST_SUITE_P(Drives, SimulatedDrives,
                         ::testing::Values(Drive{"sim_rectangle", 1.9164, 0.2241, 15, 6},
                                           Drive{"sim_out_and_back", 1.4441, 0.2953, 8, 8}));

}  // namespace
}  // namespace sslcd
