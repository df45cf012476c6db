// SPDX-License-Identifier: BSD-3-Clause
// Loops, map and trajectory against tools/eval_sequence.py, on a real sequence with true
// identities.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "eval/kitti_ground_truth.h"
#include "eval/sequence_metrics.h"
#include "judge.h"

namespace sslcd {
namespace {

using outside::Quoted;

struct Stamped {
  std::vector<double> stamps;
  std::vector<Pose> poses;
};

Stamped ReadTum(const outside::fs::path& path) {
  Stamped result;
  for (const std::vector<double>& v : outside::ReadNumbers(path)) {
    result.stamps.push_back(v[0]);
    const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
    result.poses.push_back(Pose::FromQuaternionTranslation(q, Vec3(v[1], v[2], v[3])));
  }
  return result;
}

/// Label rows in the layout frame track label truncated occluded alpha box(4) h w l x y z ry score.
std::vector<Frame> ReadDetections(const outside::fs::path& path, std::size_t count) {
  std::vector<Frame> frames(count);
  for (std::size_t i = 0; i < count; ++i) frames[i].index = static_cast<int>(i);
  std::ifstream file(path);
  int row = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::size_t frame;
    std::string word;
    double h, w, l, x, y, z, ry;
    words >> frame;
    for (int k = 0; k < 9; ++k) words >> word;
    if (!(words >> h >> w >> l >> x >> y >> z >> ry)) continue;
    Detection detection;
    detection.row = row++;
    detection.label = "Tree";
    detection.dims = {l, w, h};
    detection.T_cam_object = Pose(GravityFrame().Upright(-ry), Vec3(x, y - 0.5 * h, z));
    if (frame < count) frames[frame].detections.push_back(detection);
  }
  return frames;
}

/// True loops with a little and with too much error, and arbitrary pairs of frames.
std::vector<LoopClosure> FakeLoops(const std::vector<Pose>& reference) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::vector<LoopClosure> loops;
  for (int query = 400; query < static_cast<int>(reference.size()); query += 35) {
    int match = 0;
    double nearest_m = 12;
    for (int i = 0; i < query - 300; ++i) {
      const double distance = (reference[i].translation() - reference[query].translation()).norm();
      if (distance < nearest_m) {
        match = i;
        nearest_m = distance;
      }
    }
    Vec6 noise;
    for (double& v : noise) v = normal(random);
    noise.head<3>() *= query % 2 == 0 ? 1. : 4.;
    noise.tail<3>() *= 0.03;
    LoopClosure& loop = loops.emplace_back();
    loop.query_frame = query;
    loop.match_frame = match;
    loop.decision = LoopDecision::kAccepted;
    loop.T_match_query = reference[match].inverse() * reference[query] * Pose::Exp(noise);
  }
  return loops;
}

std::string LoopsCsv(const std::vector<LoopClosure>& loops) {
  std::ostringstream csv;
  csv.precision(17);
  csv << "query_frame,match_frame,decision,reason,score,second_score,matches,viewpoint_change_deg,"
         "tx,ty,tz,qx,qy,qz,qw,"
         "pairs\n5,1,ambiguous,margin,1,1,3,0,0,0,0,0,0,0,1,\n";
  for (const LoopClosure& loop : loops) {
    csv << loop.query_frame << ',' << loop.match_frame << ",accepted,,1,0,5,0";
    for (int k = 0; k < 3; ++k) csv << ',' << loop.T_match_query.translation()[k];
    for (int k = 0; k < 4; ++k) csv << ',' << loop.T_match_query.data()[k];
    csv << ",1:2\n";
  }
  return csv.str();
}

TEST(SequenceJudge, AgreesInEveryFigure) {
  const auto data = outside::DataDir() / "victoria-park";
  const auto judge = outside::ToolsDir() / "eval_sequence.py";
  if (!outside::fs::exists(data) || !outside::fs::exists(judge))
    GTEST_SKIP() << "skipped: no data or no judge";
  if (!outside::PythonHas("numpy")) GTEST_SKIP() << "skipped: python3 with numpy is not installed";

  const Stamped reference = ReadTum(data / "reference.txt");
  SequenceRun run;
  run.reference = reference.poses;
  run.odometry = ReadTum(data / "odometry.txt").poses;
  for (const Pose& T : run.reference) {
    const double x = T.translation().x(), z = T.translation().z();
    run.estimate.push_back(Pose::Trans(0.5 * std::sin(0.05 * z), 0, 0.7 * std::sin(0.03 * x)) * T);
  }
  run.estimate.resize(run.estimate.size() - 20);
  run.frames = ReadDetections(data / "detections.txt", run.reference.size());
  run.identities = ReadLandmarkIds((data / "landmark_ids.txt").string());
  run.objects = judge::ClusterDetections(run.frames, run.estimate, 0.5, 1.2);
  run.loops = FakeLoops({run.reference.begin(), run.reference.begin() + run.estimate.size()});
  const SequenceMetrics ours = ComputeSequenceMetrics(run);

  const outside::TempDir folder;
  outside::WriteFile(
      folder.path() / "trajectory_tum.txt",
      outside::TumText({reference.stamps.begin(), reference.stamps.begin() + run.estimate.size()},
                       run.estimate));
  outside::WriteFile(folder.path() / "map.json", judge::MapJson(run.objects));
  outside::WriteFile(folder.path() / "loops.csv", LoopsCsv(run.loops));
  const outside::CommandResult answer = outside::RunCommand(
      "python3 " + Quoted(judge) + " " + Quoted(folder.path()) + " " + Quoted(data));
  ASSERT_EQ(answer.status, 0) << answer.output;
  const judge::Verdict verdict(answer.output);

  judge::ExpectSame(verdict, "ate", ours.ate);
  judge::ExpectSame(verdict, "ate_odometry", ours.ate_odometry);
  judge::ExpectSame(verdict, "path", ours.path);
  judge::ExpectSame(verdict, "loops", ours.loops);
  judge::ExpectSame(verdict, "wrong_loops", ours.wrong_loops);
  judge::ExpectSame(verdict, "wrong_in_height", ours.wrong_in_height);
  judge::ExpectSame(verdict, "revisited_stretches", ours.revisited_stretches);
  judge::ExpectSame(verdict, "recall", ours.recall);
  judge::ExpectSame(verdict, "loop_error_median_m", ours.loop_error_median_m);
  judge::ExpectSame(verdict, "loop_error_median_deg", *ours.loop_error_median_rad * 180 / M_PI);
  judge::ExpectSame(verdict, "landmarks", ours.landmarks);
  judge::ExpectSame(verdict, "true_landmarks", ours.true_landmarks);
  judge::ExpectSame(verdict, "landmarks_per_true", ours.landmarks_per_true);
  judge::ExpectSame(verdict, "purity", ours.purity);
  for (int k = 0; k < kViewpointBins; ++k) {
    EXPECT_EQ(ours.true_by_viewpoint[k], verdict[kViewpointBinNames[k]].value_or(0))
        << kViewpointBinNames[k];
  }
  EXPECT_GT(ours.loops - ours.wrong_loops, 20);
  EXPECT_GT(ours.wrong_loops, 10);
  EXPECT_GT(ours.recall, 0.1);
  EXPECT_GT(ours.revisited_stretches, 50);
}

}  // namespace
}  // namespace sslcd
