// SPDX-License-Identifier: BSD-3-Clause
// The map's figures against tools/eval_map.py, on real detections and ground truth.
#include <gtest/gtest.h>

#include "core/sigmoid.h"
#include "eval/map_metrics.h"
#include "judge.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd {
namespace {

using outside::Quoted;

// Length of the true path over that of KITTI tracking's ORB-SLAM3 odometry: 0.965 to 0.975 on
// 0001, 0005, 0007 and 0009, where `oxts_cam0_poses` tell. Sequence 0011 has no true poses; the
// independent judge (eval_map.py) compares its maps with the odometry scaled by this, and so
// does this test, which must agree with it.
constexpr double kKittiOdometryScale = 0.975;

// The path with its positions multiplied by `scale`, the rotations kept.
std::vector<Pose> ScaledPath(const std::vector<Pose>& T_world_cam, double scale) {
  std::vector<Pose> scaled;
  for (const Pose& T : T_world_cam) scaled.emplace_back(T.so3(), scale * T.translation());
  return scaled;
}

struct Case {
  const char* sequence;
  const char* detections;
  double odometry_scale;  // what the fake run makes of the odometry
  int frames_left_out;    // at its end
  double gate_m;          // of its map
};
void PrintTo(const Case& c, std::ostream* os) { *os << c.sequence << " with " << c.detections; }

/// AB3DMOT rows: frame,type,x1,y1,x2,y2,score,h,w,l,x,y,z,ry,alpha.
std::vector<Frame> ReadDetections(const outside::fs::path& path) {
  std::vector<Frame> frames;
  int row = 0;
  for (const std::vector<double>& v : outside::ReadNumbers(path, ',')) {
    while (static_cast<int>(frames.size()) <= v[0]) {
      const int index = static_cast<int>(frames.size());
      frames.emplace_back().index = index;
    }
    Detection detection;
    detection.row = row++;
    detection.label = "Car";
    detection.score = Sigmoid(v[6]);
    detection.dims = {v[9], v[8], v[7]};
    detection.T_cam_object =
        Pose(GravityFrame().Upright(-v[13]), Vec3(v[10], v[11] - 0.5 * v[7], v[12]));
    frames[static_cast<std::size_t>(v[0])].detections.push_back(detection);
  }
  return frames;
}

class MapJudge : public ::testing::TestWithParam<Case> {};

TEST_P(MapJudge, AgreesInEveryFigure) {
  const Case& c = GetParam();
  const auto data = outside::DataDir() / "kitti-tracking";
  const auto judge = outside::ToolsDir() / "eval_map.py";
  if (!outside::fs::exists(data) || !outside::fs::exists(judge))
    GTEST_SKIP() << "skipped: no data or no judge";
  if (!outside::PythonHas("numpy, shapely"))
    GTEST_SKIP() << "skipped: python3 with numpy and shapely is not installed";
  const std::string file = std::string(c.sequence) + ".txt";
  const auto detections = data / c.detections / file;
  const std::vector<Pose> odometry = outside::ReadKittiPoses(data / "orbslam3_poses" / file);
  const bool has_reference = outside::fs::exists(data / "oxts_cam0_poses" / file);

  MapRun run;
  run.estimate = ScaledPath(odometry, c.odometry_scale);
  run.estimate.resize(run.estimate.size() - c.frames_left_out);
  run.frames = ReadDetections(detections);
  run.objects = judge::ClusterDetections(run.frames, run.estimate, 0.5, c.gate_m);
  run.reference = has_reference ? outside::ReadKittiPoses(data / "oxts_cam0_poses" / file)
                                : ScaledPath(odometry, kKittiOdometryScale);
  run.truth = ReadKittiTrackingLabels((data / "label_02" / file).string());
  const MapMetrics ours = ComputeMapMetrics(run);

  const outside::TempDir folder;
  outside::WriteFile(folder.path() / "trajectory_kitti.txt", outside::KittiText(run.estimate));
  outside::WriteFile(folder.path() / "map.json", judge::MapJson(run.objects));
  const outside::CommandResult answer =
      outside::RunCommand("python3 " + Quoted(judge) + " " + Quoted(folder.path()) + " " +
                          Quoted(data) + " " + c.sequence + " " + Quoted(detections));
  ASSERT_EQ(answer.status, 0) << answer.output;
  const judge::Verdict verdict(answer.output);

  judge::ExpectSame(verdict, "iou_raw", ours.iou_raw);
  judge::ExpectSame(verdict, "iou_raw_same_pairs", ours.iou_raw_same_pairs);
  judge::ExpectSame(verdict, "iou_map", ours.iou_map);
  judge::ExpectSame(verdict, "pairs", ours.pairs);
  judge::ExpectSame(verdict, "coverage", ours.coverage);
  judge::ExpectSame(verdict, "landmarks", ours.landmarks);
  judge::ExpectSame(verdict, "purity", ours.purity);
  judge::ExpectSame(verdict, "static_objects", ours.static_objects);
  judge::ExpectSame(verdict, "static_found", ours.static_found);
  judge::ExpectSame(verdict, "landmarks_per_static", ours.landmarks_per_static);
  judge::ExpectSame(verdict, "driving_in_map", ours.driving_in_map);
  EXPECT_GT(ours.pairs, 100);
  EXPECT_GT(ours.landmarks, 20);
  ASSERT_EQ(verdict.Has("ate"), has_reference);
  if (!has_reference) return;
  const auto ate = [&](std::vector<Pose> est, Alignment alignment) {
    const std::size_t n = std::min(est.size(), run.reference.size());
    est.resize(n);
    return ComputeAte(est, {run.reference.begin(), run.reference.begin() + n}, alignment)
        .error.rmse;
  };
  judge::ExpectSame(verdict, "ate", ate(run.estimate, Alignment::kSe3));
  judge::ExpectSame(verdict, "ate_odometry", ate(odometry, Alignment::kSe3));
  judge::ExpectSame(verdict, "ate_single_scale_floor", ate(odometry, Alignment::kSim3));
}

INSTANTIATE_TEST_SUITE_P(KittiTracking, MapJudge,
                         ::testing::Values(Case{"0007", "det_pointrcnn_car", 0.972, 0, 2.},
                                           Case{"0001", "det_pointrcnn_car", 1., 60, 4.},
                                           Case{"0011", "det_stereo_grade_car", 0.975, 0, 2.5},
                                           Case{"0009", "det_stereo_grade_car", 0.971, 0, 30.}),
                         [](const auto& test) {
                           return std::string("Sequence") + test.param.sequence;
                         });

}  // namespace
}  // namespace sslcd
