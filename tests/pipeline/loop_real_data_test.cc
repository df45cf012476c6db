// SPDX-License-Identifier: BSD-3-Clause
// Loop closure on real sequences, held to its figures (docs/results.md): one configuration for all.
// Skipped where the data is not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

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

// The identities, each named after the first one that the reference has at the same spot: two trees
// do not stand within 0.3 m of one another, and these two were never seen in one frame.
std::vector<int> WithoutDoubles(const SequenceRun& run) {
  struct Mark {
    Vec3 sum = Vec3::Zero();
    double count = 0;
    std::set<int> frames;
  };
  std::map<int, Mark> marks;
  for (const Frame& frame : run.frames) {
    for (const Detection& detection : frame.detections) {
      Mark& mark = marks[run.identities[detection.row]];
      mark.sum += run.reference[frame.index] * detection.T_cam_object.translation();
      mark.count += 1;
      mark.frames.insert(frame.index);
    }
  }
  std::map<int, int> name;
  for (const auto& [identity, mark] : marks) {
    name[identity] = identity;
    for (const auto& [other, first] : marks) {
      if (other >= identity) break;
      const Vec3 apart = mark.sum / mark.count - first.sum / first.count;
      const bool together = std::any_of(mark.frames.begin(), mark.frames.end(),
                                        [&](int frame) { return first.frames.count(frame) > 0; });
      if (!together && std::hypot(apart.x(), apart.z()) < 0.3) name[identity] = name[other];
    }
  }
  std::vector<int> joined = run.identities;
  for (int& identity : joined)
    if (identity >= 0) identity = name.at(identity);
  return joined;
}

class RealLoops : public ::testing::TestWithParam<Bar> {};

TEST_P(RealLoops, ReachTheirFigures) {
  const Bar& bar = GetParam();
  const char* root = std::getenv("SSLCD_DATA_DIR");
  const std::string data = std::string(root ? root : "../shared/data") + "/" + bar.sequence;
  if (!std::filesystem::is_directory(data))
    GTEST_SKIP() << "skipped: no data at " << data << " (SSLCD_DATA_DIR)";

  DatasetRequest request;
  request.path = data;
  request.format = DatasetFormat::kSequence;
  request.groundtruth = bar.groundtruth;
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
  EXPECT_LE(metrics.ate, bar.ate_m) << "odometry: " << metrics.ate_odometry;
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_GE(metrics.recall, bar.recall);
  EXPECT_LE(metrics.landmarks_per_true, bar.per_object);
  EXPECT_GE(metrics.purity, bar.purity);
  run.identities = WithoutDoubles(run);
  EXPECT_GE(ComputeSequenceMetrics(run).purity, .98);
  if (bar.opposite) {
    EXPECT_GT(metrics.true_by_viewpoint.back(), 0);
  }
  RecordProperty("ate_m", std::to_string(metrics.ate));
  RecordProperty("recall", std::to_string(metrics.recall));
  RecordProperty("purity", std::to_string(metrics.purity));
}

INSTANTIATE_TEST_SUITE_P(VictoriaPark, RealLoops,
                         ::testing::Values(Bar{"victoria-park", "reference.txt", 4., .70, 1.15,
                                               .965, true}));
constexpr double kNoBar = std::numeric_limits<double>::infinity();
// ATE: that of a plain solver fed with true loops.
INSTANTIATE_TEST_SUITE_P(KittiOdometryPoles, RealLoops,
                         ::testing::Values(Bar{"kitti-odometry-poles/00", "groundtruth.txt", 7.3,
                                               .60, kNoBar, 0, false},
                                           Bar{"kitti-odometry-poles/02", "groundtruth.txt", 10.6,
                                               .60, kNoBar, 0, false},
                                           Bar{"kitti-odometry-poles/05", "groundtruth.txt", 7.0,
                                               .60, kNoBar, 0, false}));

}  // namespace
}  // namespace sslcd
