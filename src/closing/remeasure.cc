// SPDX-License-Identifier: BSD-3-Clause
#include "closing/remeasure.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "closing/pass_layout.h"
#include "closing/resightings.h"
#include "loop/decision.h"
#include "odometry/odometry_edge.h"

namespace sslcd {
namespace {

// Measures the loop in the refined map; none if its objects do not determine it well enough.
std::optional<LoopClosure> MeasureAgain(const MapState& state, const PassMap& passes,
                                        const LoopAttempt& attempt, const LoopOptions& options,
                                        const OdometryFactors& factors) {
  if (attempt.found.sigma_m <= 0) return std::nullopt;
  const LoopLayoutOptions& o = options.layout;
  const SearchWindow& window = attempt.window;
  const PassLayout local =
      PassLayouts(passes, state)
          .Between(window.end_m - window.local_m, window.end_m, o.min_sightings);
  CommonObjects common{local, {}, attempt.found.sigma_m, window.GlobalMapEnd(o.gap_m)};
  for (std::size_t i = 0; i < local.objects.size(); ++i) {
    const LandmarkId id{local.objects[i].id};
    if (PassLayouts(passes, state).PlaceBefore(id, common.global_end_m, o.min_sightings))
      common.pairs.push_back({static_cast<int>(i), id});
  }
  const LoopMeasurement& loop = attempt.found.loop;
  const LoopMeter meter(common, state, passes, options, factors);
  auto now = meter.MeasureBetween(loop.query, loop.match);
  if (!now || now->heading_sigma >= options.acceptance.max_heading_sigma_rad) return std::nullopt;
  return std::move(now->row);
}

double Uncertainty(const Pose::Matrix6& covariance) {
  return covariance.topLeftCorner<3, 3>().trace();
}

}  // namespace

void ReviewLoops(const MapState& state, const PassMap& passes, LoopLedger& ledger,
                 const LoopOptions& options, const OdometryFactors& factors) {
  for (LoopAttempt& attempt : ledger.attempts()) {
    if (!attempt.accepted()) continue;
    const LoopMeasurement& loop = attempt.found.loop;
    const Pose T_match_query =
        state.frames[loop.match].T_world_cam.inverse() * state.frames[loop.query].T_world_cam;
    if (IsWithdrawn(loop.row, T_match_query, options.acceptance)) {
      attempt.row().decision = LoopDecision::kAmbiguous;
      attempt.row().reason = "the refined trajectory disagrees";
    } else {
      attempt.remeasured = MeasureAgain(state, passes, attempt, options, factors);
    }
  }
}

void MeasureByViews(const MapState& state, const std::vector<ViewTie>& ties, double scale,
                    const OdometryNoise& noise, LoopLedger& ledger) {
  // Largest path from the loop to the tie on both passes together, since odometry adds errors. In
  // case 1, seed 5 of rendered HALV-sim fifteen loops have no tie within it (docs/notes, "From
  // images alone"). Set by hand. [m of path]
  constexpr double kNear = 30;
  const FrameStore& frames = state.frames;
  const auto path = [&](int a, int b) {
    return std::abs(frames[a].travelled - frames[b].travelled);
  };
  const auto walk = [&](int from, int to) {
    return OdometryBetween(frames, from, to, {noise, {}}, state.gravity().up, scale).Measurement();
  };
  for (LoopAttempt& attempt : ledger.attempts()) {
    if (!attempt.accepted()) continue;
    const int match = attempt.found.loop.match, query = attempt.found.loop.query;
    const LoopClosure& by_objects = attempt.remeasured ? *attempt.remeasured : attempt.row();
    RelativePose best{by_objects.T_match_query, by_objects.covariance};
    bool better = false;
    for (const ViewTie& tie : ties) {
      if (path(match, tie.from) + path(query, tie.to) > kNear) continue;
      const RelativePose by_views =
          Compose(Compose(walk(match, tie.from), tie.pose), walk(tie.to, query));
      if (!(Uncertainty(by_views.covariance) < Uncertainty(best.covariance))) continue;
      best = by_views;
      better = true;
    }
    if (!better) continue;
    LoopClosure row = by_objects;
    row.T_match_query = best.T_a_b;
    row.covariance = best.covariance;
    row.by_views = true;
    const Pose& T_world_match = frames[match].T_world_cam;
    row.viewpoint_change_rad =
        ViewpointChange(T_world_match, T_world_match * best.T_a_b, state.gravity());
    attempt.remeasured = std::move(row);
  }
}

OdometryByLoops LearnOdometry(const MapState& state, const LoopLedger& ledger, double scale,
                              const LoopOptions& options, double corrected) {
  if (!options.learn_odometry) return {};
  const Vec3 up = state.gravity().up;
  const LoopGraph graph =
      BuildLoopGraph(state.frames, ledger.AcceptedEdges(), scale, up, options, {});
  std::vector<OdometryFailures> failures;
  for (std::size_t k = 1; k < graph.keyframes.size(); ++k)
    failures.push_back(FailuresBetween(state.frames, graph.keyframes[k - 1], graph.keyframes[k]));
  return LearnOdometryByLoops(graph.graph, up, corrected, failures);
}

OdometryFactors FactorsOfRefinement(const OdometryByLoops& by_loops,
                                    const OdometryFactors& in_sight, const LoopOptions& options) {
  OdometryFactors factors = in_sight;
  factors.horizontal = factors.heading = 1;
  if (!options.learn_odometry) return factors;
  factors.horizontal = std::max(by_loops.horizontal, in_sight.horizontal / kCaution);
  factors.heading = std::max(by_loops.heading, in_sight.heading);
  return factors;
}

}  // namespace sslcd
