// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "closing/global_layout.h"
#include "closing/loop_finder.h"
#include "closing/loop_prior.h"
#include "closing/pass_layout.h"
#include "closing/trajectory_uncertainty.h"
#include "core/sigmoid.h"
#include "loop/appearance_likelihood.h"
#include "loop/decision.h"
#include "loop/pose_tracks.h"

namespace sslcd {
namespace {

class TrackFinder : public LoopFinder {
 public:
  explicit TrackFinder(const LoopOptions& options)
      : options_(options), global_(options), tracks_(options.tracks) {}

  std::unique_ptr<LoopFinder> Clone() const override {
    return std::make_unique<TrackFinder>(*this);
  }

  std::optional<FoundLoop> Find(const FinderInput& input) override {
    const SearchWindow& window = input.window;
    const double global_end_m = window.GlobalMapEnd(options_.layout.gap_m);
    const PassLayout local =
        PassLayouts(input.passes, input.state)
            .Between(window.end_m - window.local_m, window.end_m, options_.layout.min_sightings);
    const LayoutIndex& index = global_.Update(input.state, input.passes, global_end_m);
    const std::size_t few = static_cast<std::size_t>(options_.match.search.min_matches);
    if (std::min(local.objects.size(), index.objects().size()) < few) return std::nullopt;
    const TrajectoryUncertainty uncertainty(input.state, input.loops,
                                            {options_.odometry, input.odometry});
    const OdometryPrior prior(input.state, input.passes, local, index, uncertainty,
                              input.state.frames.AtPath(window.end_m - 0.5 * window.local_m));
    UpdateTracks(input, local, index, prior);
    if (tracks_.tracks().empty()) return std::nullopt;

    const PoseTrack& best = tracks_.tracks()[0];
    const CommonObjects common{local, OldLandmarks(best.fit.matches, index), best.fit.sigma,
                               global_end_m};
    LoopMeter meter(common, input.state, input.passes, options_, input.odometry);
    auto loop = meter.Measure(window.end_m - window.lag_m, window.beyond_m);
    if (!loop) return std::nullopt;
    const auto decide = [&, appearance =
                                AppearanceOf(best.fit, local, index)](LoopMeasurement measured) {
      return Decide(std::move(measured), best, appearance, prior, index.pose_volume());
    };
    FoundLoop found = decide(std::move(*loop));
    if (found.loop.row.decision != LoopDecision::kAccepted) return found;
    for (const double camera_m : input.early_m) {
      auto later = meter.Measure(camera_m, options_.lag_m);
      if (!later) continue;
      FoundLoop early = decide(std::move(*later));
      if (early.loop.row.decision == LoopDecision::kAccepted) found.early.push_back(early);
    }
    return found;
  }

  void MoveLocalMap(const YawShift& change) override { tracks_.Move(change); }
  void Reset() override { tracks_.Forget(); }

 private:
  void UpdateTracks(const FinderInput& input, const PassLayout& local, const LayoutIndex& index,
                    const OdometryPrior& prior) {
    const LayoutLikelihood likelihood(local.objects, index, options_.match.likelihood,
                                      {prior.LargestRise()});
    PoseSearchOptions search = options_.match.search;
    // fewer, since the tracks keep the poses of earlier attempts
    search.refine = options_.tracks.max_tracks;
    std::vector<PoseHypothesis> found = SearchPoses(
        likelihood, search, [&prior](const YawShift& pose) { return prior.Rank(pose); });
    PoseHypothesis no_drift;  // the current pose of the trajectory as hypothesis
    no_drift.fit = likelihood.Refine(no_drift.pose, kRefineRounds);
    if (static_cast<int>(no_drift.fit.matches.size()) >= search.min_matches)
      found.insert(found.begin(), no_drift);
    tracks_.Update(
        likelihood, found, search, input.window.end_m,
        input.window.GlobalMapEnd(options_.layout.gap_m),
        [&prior](const YawShift& pose, const LayoutFit& fit) { return prior.Of(pose, fit); });
  }

  // Log likelihood ratio of the looks of the matched objects: the same ones against others. [nats]
  double AppearanceOf(const LayoutFit& fit, const PassLayout& local,
                      const LayoutIndex& index) const {
    double sum = 0;
    for (const auto& [i, j] : fit.matches)
      sum += AppearanceGain(local.objects[i], index.objects()[j],
                            options_.match.likelihood.appearance);
    return sum;
  }

  FoundLoop Decide(LoopMeasurement loop, const PoseTrack& best, double appearance,
                   const OdometryPrior& prior, double searched) const {
    TrackEvidence evidence;
    evidence.evidence = best.evidence;
    evidence.margin = tracks_.Margin(0);
    evidence.second_margin = tracks_.Margin(1);
    evidence.own_evidence = EvidenceOnTrack(best.fit.evidence, searched);
    evidence.height = prior.OfHeight(loop);
    evidence.heading_sigma_rad = loop.heading_sigma;
    evidence.joins = best.prior.joins;
    evidence.lead = tracks_.Lead();
    evidence.appearance = appearance;
    const TrackVerdict verdict = DecideTrack(evidence, options_.acceptance);
    FoundLoop found{std::move(loop), best.fit.sigma, best.id, verdict.confirmed};
    LoopClosure& row = found.loop.row;
    row.decision = verdict.loop.decision;
    row.score = verdict.loop.score;
    row.second_score = verdict.loop.second_score;
    row.probability = Sigmoid(row.score);
    row.reason = row.decision == LoopDecision::kAccepted
                     ? std::to_string(row.pairs.size()) + " objects agree"
                     : verdict.loop.reason;
    return found;
  }

  LoopOptions options_;
  GlobalLayout global_;
  PoseTracks tracks_;
};

}  // namespace

std::unique_ptr<LoopFinder> MakeTrackFinder(const LoopOptions& options) {
  return std::make_unique<TrackFinder>(options);
}

}  // namespace sslcd
