// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation.h"

#include <algorithm>
#include <cmath>

#include "eval/map_metrics.h"
#include "eval/sequence_metrics.h"
#include "sslcd/core/log.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::apps {
namespace {

// Whether row i of the true poses is that of frame i, as far as there are rows: then frames and
// rows can be compared.
bool IsByFrame(const EvaluationInput& input) {
  if (!input.groundtruth_has_stamps) return true;
  const std::vector<double>& stamps = input.groundtruth->stamps;
  for (std::size_t i = 0; i < input.estimate.size(); ++i) {
    const std::size_t row = input.frames.empty() ? i : static_cast<std::size_t>(input.frames[i]);
    if (row >= stamps.size()) break;
    if (!(std::abs(stamps[row] - input.estimate.stamps[i]) < 1e-3)) return false;
  }
  return true;
}

// Pairs an estimate with the ground truth: by stamp if both have stamps, otherwise by frame number.
MatchedPoses Pair(const Trajectory& estimate, const EvaluationInput& input) {
  if (!IsByFrame(input)) return MatchByStamp(estimate, *input.groundtruth);
  MatchedPoses matched;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const std::size_t row = input.frames.empty() ? i : static_cast<std::size_t>(input.frames[i]);
    if (row >= input.groundtruth->size()) continue;
    matched.est.push_back(estimate.poses[i]);
    matched.ref.push_back(input.groundtruth->poses[row]);
  }
  return matched;
}

void AddTrajectoryErrors(const EvaluationInput& input, Metrics& metrics) {
  const MatchedPoses matched = Pair(input.estimate, input);
  for (const Alignment alignment :
       {Alignment::kSe3, Alignment::kSim3, Alignment::k4Dof, Alignment::kNone}) {
    const ErrorStats error = ComputeAte(matched.est, matched.ref, alignment).error;
    const std::string name = std::string("ate_") + ToString(alignment);
    metrics.emplace_back(name + "_rmse_m", error.rmse);
    if (alignment != Alignment::kSe3) continue;
    metrics.emplace_back(name + "_mean_m", error.mean);
    metrics.emplace_back(name + "_median_m", error.median);
    metrics.emplace_back(name + "_std_m", error.std);
    metrics.emplace_back(name + "_max_m", error.max);
  }
  const RpeResult rpe = ComputeRpe(matched.est, matched.ref);
  metrics.emplace_back("rpe_1_frame_rmse_m", rpe.translation.rmse);
  metrics.emplace_back("rpe_1_frame_rmse_rad", rpe.rotation_rad.rmse);
  if (!input.odometry) return;
  const MatchedPoses odometry = Pair(*input.odometry, input);
  metrics.emplace_back("odometry_ate_se3_rmse_m",
                       ComputeAte(odometry.est, odometry.ref, Alignment::kSe3).error.rmse);
  metrics.emplace_back("odometry_ate_sim3_rmse_m",
                       ComputeAte(odometry.est, odometry.ref, Alignment::kSim3).error.rmse);
}

// Poses by frame number. A frame that was not processed gets the last pose before it.
std::vector<Pose> ByFrame(const Trajectory& trajectory, const std::vector<int>& frames) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const std::size_t frame = frames.empty() ? i : static_cast<std::size_t>(frames[i]);
    while (poses.size() < frame) poses.push_back(poses.empty() ? Pose() : poses.back());
    poses.push_back(trajectory.poses[i]);
  }
  return poses;
}

void AddMapErrors(const EvaluationInput& input, Metrics& metrics) {
  MapRun run;
  run.estimate = ByFrame(input.estimate, input.frames);
  run.objects = input.map->objects;
  run.frames = *input.detections;
  run.truth = ReadKittiTrackingLabels(input.labels_path);
  run.reference = input.groundtruth->poses;
  const MapMetrics map = ComputeMapMetrics(run);
  metrics.emplace_back("iou_raw", map.iou_raw);
  metrics.emplace_back("iou_raw_same_pairs", map.iou_raw_same_pairs);
  metrics.emplace_back("iou_map", map.iou_map);
  metrics.emplace_back("iou_pairs", map.pairs);
  metrics.emplace_back("coverage", map.coverage);
  metrics.emplace_back("landmarks", map.landmarks);
  metrics.emplace_back("purity", map.purity);
  metrics.emplace_back("static_objects", map.static_objects);
  metrics.emplace_back("static_found", map.static_found);
  metrics.emplace_back("landmarks_per_static", map.landmarks_per_static);
  metrics.emplace_back("driving_in_map", map.driving_in_map);
}

void AddSequenceErrors(const EvaluationInput& input, Metrics& metrics) {
  SequenceRun run;
  run.estimate = ByFrame(input.estimate, input.frames);
  run.odometry = ByFrame(*input.odometry, input.frames);
  run.reference = input.groundtruth->poses;
  run.frames = *input.detections;
  run.identities = input.identities;
  run.loops = input.loops;
  run.objects = input.map->objects;
  const SequenceMetrics m = ComputeSequenceMetrics(run);
  metrics.emplace_back("path_m", m.path);
  metrics.emplace_back("loops", m.loops);
  metrics.emplace_back("loops_wrong", m.wrong_loops);
  metrics.emplace_back("loops_wrong_in_height", m.wrong_in_height);
  for (int bin = 0; bin < kViewpointBins; ++bin)
    metrics.emplace_back(std::string("loops_true_") + kViewpointBinNames[bin] + "_deg",
                         m.true_by_viewpoint[bin]);
  metrics.emplace_back("loop_error_median_m", m.loop_error_median_m);
  metrics.emplace_back("loop_error_median_rad", m.loop_error_median_rad);
  metrics.emplace_back("revisited_stretches", m.revisited_stretches);
  metrics.emplace_back("revisits_recognised", m.recall);
  metrics.emplace_back("landmarks", m.landmarks);
  metrics.emplace_back("landmarks_per_true", m.landmarks_per_true);
  metrics.emplace_back("purity", m.purity);
}

}  // namespace

Metrics Evaluate(const EvaluationInput& input) {
  Metrics metrics;
  if (input.groundtruth) AddTrajectoryErrors(input, metrics);
  const bool has_map = input.map != nullptr && input.detections != nullptr;
  if (!input.labels_path.empty() && has_map) {
    if (input.groundtruth && IsByFrame(input))
      AddMapErrors(input, metrics);
    else
      Log(LogLevel::kWarning,
          input.labels_path +
              ": no ground-truth poses of the frames, so the map is not compared "
              "with these labels (--groundtruth)");
  }
  if (!input.identities.empty() && input.groundtruth && input.odometry && has_map) {
    if (IsByFrame(input) && input.groundtruth->size() >= input.detections->size())
      AddSequenceErrors(input, metrics);
    else
      Log(LogLevel::kWarning, "the ground truth has no pose for each frame: loops are not judged");
  }
  return metrics;
}

}  // namespace sslcd::apps
