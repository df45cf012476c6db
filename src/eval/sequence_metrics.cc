// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/eval/sequence_metrics.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "eval/identities.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd {
namespace {

/// Direction the camera looks in, in the horizontal plane. [rad]
double Heading(const Pose& T_world_cam) {
  const Vec3 view = T_world_cam.so3() * Vec3(Vec3::UnitZ());
  return std::atan2(view.x(), view.z());
}

std::vector<double> DistanceAlong(const std::vector<Pose>& poses) {
  std::vector<double> distance{0.};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    distance.push_back(distance.back() + (poses[i].translation() - poses[i - 1].translation()).norm());
  }
  return distance;
}

int IdentityOfRow(const std::vector<int>& identities, int row) {
  if (row < 0 || row >= static_cast<int>(identities.size())) {
    throw Error(ErrorKind::kUsage, "detection row " + std::to_string(row) + " has no true identity: there are " +
                                       std::to_string(identities.size()) + " identities, for the rows from 0 on");
  }
  return identities[row];
}

/// Positions along the path [m] at which something of long ago should be recognised.
std::vector<double> RevisitedMarks(const SequenceRun& run, const std::vector<double>& distance,
                                   const SequenceMetricOptions& options) {
  std::vector<std::pair<double, int>> sightings;  // (position along the path, identity)
  for (const Frame& frame : run.frames) {
    if (frame.index < 0 || frame.index >= static_cast<int>(distance.size())) continue;
    for (const Detection& detection : frame.detections) {
      const int identity = IdentityOfRow(run.identities, detection.row);
      if (identity >= 0) sightings.emplace_back(distance[frame.index], identity);
    }
  }
  std::vector<double> marks;
  for (double mark = options.old_m; mark < distance.back(); mark += options.spacing_m) {
    std::set<int> recent, old;
    for (const auto& [position, identity] : sightings) {
      if (mark - options.recent_m < position && position <= mark) recent.insert(identity);
      if (position < mark - options.old_m) old.insert(identity);
    }
    const auto common =
        std::count_if(recent.begin(), recent.end(), [&old = old](int identity) { return old.count(identity) > 0; });
    if (common >= options.common) marks.push_back(mark);
  }
  return marks;
}

void JudgeLoops(const SequenceRun& run, const std::vector<Pose>& reference, const SequenceMetricOptions& options,
                SequenceMetrics& metrics) {
  const std::vector<double> distance = DistanceAlong(reference);
  const std::vector<double> marks = RevisitedMarks(run, distance, options);
  const int n = static_cast<int>(reference.size());
  std::set<double> hit;
  std::vector<double> errors_m, errors_rad;
  for (const LoopClosure& loop : run.loops) {
    if (loop.decision != LoopDecision::kAccepted) continue;
    if (std::min(loop.query_frame, loop.match_frame) < 0 || std::max(loop.query_frame, loop.match_frame) >= n) {
      throw Error(ErrorKind::kUsage, "the loop " + std::to_string(loop.query_frame) + " - " +
                                         std::to_string(loop.match_frame) + " is outside of the " + std::to_string(n) +
                                         " frames that have a pose in all trajectories");
    }
    const Pose& query = reference[loop.query_frame];
    const Pose& match = reference[loop.match_frame];
    const Pose error = (match.inverse() * query).inverse() * loop.T_match_query;
    errors_m.push_back(std::hypot(error.translation().x(), error.translation().z()));
    errors_rad.push_back(error.so3().Log().norm());
    if (!(errors_m.back() < options.true_loop_m && errors_rad.back() < options.true_loop_rad)) {
      ++metrics.wrong_loops;
      continue;
    }
    ++metrics.true_by_viewpoint[ViewpointBin(Heading(query) - Heading(match))];
    const double at = distance[loop.query_frame];
    for (const double mark : marks) {
      if (mark - options.spacing_m < at && at <= mark + options.spacing_m) hit.insert(mark);
    }
  }
  metrics.loops = static_cast<int>(errors_m.size());
  metrics.revisited_stretches = static_cast<int>(marks.size());
  metrics.recall = static_cast<double>(hit.size()) / std::max<std::size_t>(1, marks.size());
  metrics.path = distance.back();
  if (errors_m.empty()) return;
  metrics.loop_error_median_m = Summarise(errors_m).median;
  metrics.loop_error_median_rad = Summarise(errors_rad).median;
}

void JudgeMap(const SequenceRun& run, SequenceMetrics& metrics) {
  const Identities found = FindIdentities(run.objects, [&](int row) {
    const int identity = IdentityOfRow(run.identities, row);
    return identity >= 0 ? std::optional<int>(identity) : std::nullopt;
  });
  std::set<int> all(run.identities.begin(), run.identities.end());
  all.erase(all.begin(), all.lower_bound(0));
  int owned = 0;
  for (const auto& [identity, landmarks] : found.owned) owned += landmarks;
  metrics.landmarks = found.landmarks;
  metrics.true_landmarks = static_cast<int>(all.size());
  metrics.landmarks_per_true = static_cast<double>(owned) / std::max<std::size_t>(1, found.owned.size());
  metrics.purity = found.Purity();
}

}  // namespace

SequenceMetrics ComputeSequenceMetrics(const SequenceRun& run, const SequenceMetricOptions& options) {
  const std::size_t n = std::min({run.estimate.size(), run.odometry.size(), run.reference.size()});
  const auto cut = [n](const std::vector<Pose>& poses) { return std::vector<Pose>(poses.begin(), poses.begin() + n); };
  const std::vector<Pose> reference = cut(run.reference);
  SequenceMetrics metrics;
  metrics.ate = ComputeAte(cut(run.estimate), reference).error.rmse;
  metrics.ate_odometry = ComputeAte(cut(run.odometry), reference).error.rmse;
  JudgeLoops(run, reference, options, metrics);
  JudgeMap(run, metrics);
  return metrics;
}

}  // namespace sslcd
