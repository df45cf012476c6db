// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_view.h"

#include <algorithm>
#include <filesystem>

#include "datasets/run_folder.h"
#include "formats/files.h"
#include "formats/loops_csv.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/trajectory_error.h"
#include "sslcd/formats/poses.h"

namespace sslcd {
namespace {

// The true poses, moved onto the trajectory.
Trajectory Align(const PoseFile& truth, const Trajectory& trajectory) {
  Trajectory reference = truth.trajectory;
  if (truth.format == PoseFormat::kKitti) {  // row i is frame i
    const std::size_t rows = std::min(reference.size(), trajectory.size());
    reference.poses.resize(rows);
    reference.stamps.assign(trajectory.stamps.begin(),
                            trajectory.stamps.begin() + static_cast<std::ptrdiff_t>(rows));
  }
  if (reference.poses.empty() || trajectory.poses.empty()) return {};
  const MatchedPoses matched = MatchByStamp(trajectory, reference);
  const Similarity onto = sslcd::Align(matched.ref, matched.est, Alignment::kSe3);
  for (Pose& pose : reference.poses) pose = onto * pose;
  return reference;
}

bool InTrajectory(const LoopClosure& loop, const Trajectory& trajectory) {
  const int frames = static_cast<int>(trajectory.size());
  return loop.query_frame >= 0 && loop.query_frame < frames && loop.match_frame >= 0 &&
         loop.match_frame < frames;
}

}  // namespace

RunView ReadRun(const std::string& folder, const std::string& groundtruth) {
  const std::filesystem::path root(folder);
  if (!IsFolder(folder) || IfFile(root / "map.json").empty())
    throw Error(ErrorKind::kBadInput,
                folder + ": holds no map.json; name a folder that 'sslcd_run run' has written");
  RunView run;
  run.folder = folder;
  run.record = CheckRunFolder(folder);
  run.map = ReadMapJson(root / "map.json");
  auto& objects = run.map.objects;
  objects.erase(std::remove_if(objects.begin(), objects.end(),
                               [](const MapObject& object) {
                                 return object.state != LandmarkState::kConfirmed;
                               }),
                objects.end());
  run.gravity = GravityFrame::FromUp(run.map.up_axis);
  run.trajectory = ReadTrajectory(root / "trajectory_tum.txt");
  run.odometry = ReadTrajectory(root / "odometry_tum.txt");
  run.loops = ReadLoopsCsv(root / "loops.csv");
  run.metrics_json = ReadFileBytes(root / "metrics.json");
  run.timing_json = ReadFileBytes(root / "timing.json");
  run.config_yaml = ReadFileBytes(root / "config.yaml");
  const std::string truth =
      !groundtruth.empty() ? groundtruth : IfFile(root / "groundtruth_tum.txt");
  if (!truth.empty()) run.truth = Align(ReadPoseFile(truth), run.trajectory);
  return run;
}

void RequirePoses(const RunView& run) {
  if (run.trajectory.poses.empty() || run.odometry.size() != run.trajectory.size())
    throw Error(ErrorKind::kBadInput,
                run.folder + ": the run has no poses, or not those of its odometry: repeat it");
}

Eigen::Matrix3d PageAxes(const GravityFrame& gravity) {
  Eigen::Matrix3d R_page_world;
  R_page_world.row(0) = gravity.forward.transpose();
  R_page_world.row(1) = gravity.up.transpose();
  R_page_world.row(2) = -gravity.left.transpose();
  return R_page_world;
}

bool IsRound(const RunView& run, const std::string& label) {
  return run.record && run.record->labels[label].symmetry == Symmetry::kFull;
}

std::map<std::string, Colour> LabelColours(const RunView& run) {
  std::map<std::string, Colour> colours;
  for (const MapObject& object : run.map.objects) colours.emplace(object.label, Colour());
  std::size_t i = 0;
  for (auto& [label, colour] : colours) colour = LabelColour(i++);
  return colours;
}

std::vector<LoopClosure> AcceptedLoops(const RunView& run) {
  std::vector<LoopClosure> loops;
  for (const LoopClosure& loop : run.loops)
    if (loop.decision == LoopDecision::kAccepted && InTrajectory(loop, run.trajectory))
      loops.push_back(loop);
  std::stable_sort(loops.begin(), loops.end(), [](const LoopClosure& a, const LoopClosure& b) {
    return a.query_frame < b.query_frame;
  });
  return loops;
}

}  // namespace sslcd
