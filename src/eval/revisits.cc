// SPDX-License-Identifier: BSD-3-Clause
#include "eval/revisits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "eval/identities.h"
#include "eval/path.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kRoundingM = 1e-3;  // of path lengths

// The nearest camera before path position `end_m`, if any is nearer than revisit.distance_m. A
// camera cannot come nearer by more than the path it covers, so those that stay too far are left
// out.
void FindOldCamera(const std::vector<Pose>& reference, const std::vector<double>& path_m,
                   double end_m, Revisit& revisit) {
  const Vec3 at = reference[revisit.frame].translation();
  for (int old = 0; old < revisit.frame && path_m[old] < end_m;) {
    const Vec3 apart = reference[old].translation() - at;
    const double horizontal = std::hypot(apart.x(), apart.z());
    if (horizontal < revisit.distance_m) {
      revisit.distance_m = horizontal;
      revisit.old_frame = old;
    }
    const double reach_m = path_m[old] + (horizontal - revisit.distance_m) - kRoundingM;
    const auto next = std::lower_bound(path_m.begin() + old + 1, path_m.end(), reach_m);
    old = static_cast<int>(next - path_m.begin());
  }
}

}  // namespace

std::vector<Revisit> FindRevisits(const std::vector<Pose>& reference,
                                  const std::vector<Frame>& frames,
                                  const std::vector<int>& identities,
                                  const RevisitOptions& options) {
  const std::vector<double> distance = DistanceAlong(reference);
  const int n = static_cast<int>(reference.size());
  std::map<int, std::vector<double>> seen;  // path positions by identity
  for (const Frame& frame : frames) {
    if (frame.index < 0 || frame.index >= n) continue;
    for (const Detection& detection : frame.detections) {
      const int identity = IdentityOfRow(identities, detection.row);
      if (identity >= 0) seen[identity].push_back(distance[frame.index]);
    }
  }
  std::vector<Revisit> revisits;
  double next = 0;
  for (int f = 0; f < n; ++f) {
    if (distance[f] < next) continue;
    next = distance[f] + options.spacing_m;
    Revisit revisit;
    revisit.frame = f;
    revisit.at_m = distance[f];
    revisit.distance_m = options.radius_m;
    revisit.old_frame = -1;
    FindOldCamera(reference, distance, distance[f] - options.old_m, revisit);
    if (revisit.old_frame < 0) continue;
    for (const auto& [identity, places] : seen) {
      const bool now = std::any_of(places.begin(), places.end(), [&](double m) {
        return std::abs(m - revisit.at_m) <= options.around_m;
      });
      revisit.common += now && places.front() < revisit.at_m - options.old_m;
    }
    if (revisit.common < options.common) continue;
    revisit.viewpoint_rad =
        std::abs(WrapAngle(HeadingOf(reference[f]) - HeadingOf(reference[revisit.old_frame])));
    revisits.push_back(revisit);
  }
  return revisits;
}

std::vector<LoopOutcome> MeasureLoopErrors(const std::vector<LoopClosure>& loops,
                                           const std::vector<Pose>& reference) {
  const std::vector<double> distance = DistanceAlong(reference);
  const int n = static_cast<int>(reference.size());
  std::vector<LoopOutcome> outcomes;
  for (const LoopClosure& loop : loops) {
    if (std::min(loop.query_frame, loop.match_frame) < 0 ||
        std::max(loop.query_frame, loop.match_frame) >= n)
      throw Error(ErrorKind::kUsage, "the loop " + std::to_string(loop.query_frame) + " - " +
                                         std::to_string(loop.match_frame) + " is outside of the " +
                                         std::to_string(n) + " frames that have a true pose");
    const Pose &query = reference[loop.query_frame], &match = reference[loop.match_frame];
    const Pose error = (match.inverse() * query).inverse() * loop.T_match_query;
    LoopOutcome& outcome = outcomes.emplace_back();
    outcome.accepted = loop.decision == LoopDecision::kAccepted;
    outcome.score = loop.score;
    outcome.at_m = distance[loop.query_frame];
    outcome.error_m = std::hypot(error.translation().x(), error.translation().z());
    outcome.height_error_m = std::abs(error.translation().y());
    outcome.error_rad = error.so3().Log().norm();
    outcome.viewpoint_rad = std::abs(WrapAngle(HeadingOf(query) - HeadingOf(match)));
  }
  return outcomes;
}

std::vector<ScoredAnswer> AnswersOf(const std::vector<Revisit>& revisits,
                                    const std::vector<LoopOutcome>& loops, double true_m,
                                    const RevisitOptions& options) {
  std::vector<ScoredAnswer> answers;
  for (const Revisit& revisit : revisits) {
    const LoopOutcome* best = nullptr;
    for (const LoopOutcome& loop : loops) {
      if (loop.error_m >= true_m || std::abs(loop.at_m - revisit.at_m) > options.spacing_m)
        continue;
      if (best == nullptr || loop.score > best->score) best = &loop;
    }
    if (best != nullptr) answers.push_back({best->score, true, revisit.viewpoint_rad});
  }
  for (const LoopOutcome& loop : loops)
    if (loop.error_m >= true_m) answers.push_back({loop.score, false, loop.viewpoint_rad});
  return answers;
}

}  // namespace sslcd
