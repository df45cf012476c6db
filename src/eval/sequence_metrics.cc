// SPDX-License-Identifier: BSD-3-Clause
#include "eval/sequence_metrics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "eval/identities.h"
#include "eval/path.h"
#include "eval/revisits.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd {
namespace {

constexpr int kAnyIdentity = std::numeric_limits<int>::max();

/// Path positions [m] at which an old place should be recognised.
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
  std::sort(sightings.begin(), sightings.end());
  std::vector<double> marks;
  for (double mark = options.old_m; mark < distance.back(); mark += options.spacing_m) {
    // a path with a pose far off is endless: goes on at the next sighting, as far as steps count
    if (mark + options.spacing_m == mark) break;
    const auto next = std::upper_bound(sightings.begin(), sightings.end(),
                                       std::pair(mark - options.recent_m, kAnyIdentity));
    if (next == sightings.end()) break;
    if (next->first > mark)
      mark += options.spacing_m * std::ceil((next->first - mark) / options.spacing_m);
    if (mark >= distance.back()) break;
    std::set<int> recent, old;
    for (const auto& [position, identity] : sightings) {
      if (mark - options.recent_m < position && position <= mark) recent.insert(identity);
      if (position < mark - options.old_m) old.insert(identity);
    }
    const auto common = std::count_if(recent.begin(), recent.end(), [&old = old](int identity) {
      return old.count(identity) > 0;
    });
    if (common >= options.common) marks.push_back(mark);
  }
  return marks;
}

void AddLoops(const SequenceRun& run, const std::vector<Pose>& reference,
              const SequenceMetricOptions& options, SequenceMetrics& metrics) {
  const std::vector<double> distance = DistanceAlong(reference);
  const std::vector<double> marks = RevisitedMarks(run, distance, options);
  std::vector<LoopClosure> accepted;
  std::copy_if(run.loops.begin(), run.loops.end(), std::back_inserter(accepted),
               [](const LoopClosure& loop) { return loop.decision == LoopDecision::kAccepted; });
  std::set<double> hit;
  std::vector<double> errors_m, errors_rad;
  for (const LoopOutcome& loop : MeasureLoopErrors(accepted, reference)) {
    errors_m.push_back(loop.error_m);
    errors_rad.push_back(loop.error_rad);
    const bool height_right = loop.height_error_m < options.true_loop_height_m;
    metrics.wrong_in_height += height_right ? 0 : 1;
    if (!(height_right && loop.error_m < options.true_loop_m &&
          loop.error_rad < options.true_loop_rad)) {
      ++metrics.wrong_loops;
      continue;
    }
    ++metrics.true_by_viewpoint[ViewpointBin(loop.viewpoint_rad)];
    for (const double mark : marks)
      if (mark - options.spacing_m < loop.at_m && loop.at_m <= mark + options.spacing_m)
        hit.insert(mark);
  }
  metrics.loops = static_cast<int>(errors_m.size());
  metrics.revisited_stretches = static_cast<int>(marks.size());
  metrics.recall = static_cast<double>(hit.size()) / std::max<std::size_t>(1, marks.size());
  metrics.path = distance.back();
  if (errors_m.empty()) return;
  metrics.loop_error_median_m = Summarise(errors_m).median;
  metrics.loop_error_median_rad = Summarise(errors_rad).median;
}

void EvaluateMap(const SequenceRun& run, SequenceMetrics& metrics) {
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
  metrics.landmarks_per_true =
      static_cast<double>(owned) / std::max<std::size_t>(1, found.owned.size());
  metrics.purity = found.Purity();
}

}  // namespace

SequenceMetrics ComputeSequenceMetrics(const SequenceRun& run,
                                       const SequenceMetricOptions& options) {
  const std::size_t n = std::min({run.estimate.size(), run.odometry.size(), run.reference.size()});
  const auto cut = [n](const std::vector<Pose>& poses) {
    return std::vector<Pose>(poses.begin(), poses.begin() + n);
  };
  const std::vector<Pose> reference = cut(run.reference);
  SequenceMetrics metrics;
  metrics.ate = ComputeAte(cut(run.estimate), reference).error.rmse;
  metrics.ate_odometry = ComputeAte(cut(run.odometry), reference).error.rmse;
  AddLoops(run, reference, options, metrics);
  EvaluateMap(run, metrics);
  return metrics;
}

}  // namespace sslcd
