// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_closer.h"

#include <utility>

#include "closing/loop_corrector.h"
#include "closing/remeasure.h"
#include "closing/resightings.h"

namespace sslcd {
namespace {

std::unique_ptr<LoopFinder> MakeFinder(const LoopOptions& options, const PlaceMatcher& matcher) {
  if (matcher) return MakeHostFinder(options, matcher);
  return options.finder == LoopOptions::Finder::kPrinted ? MakePrintedFinder(options)
                                                         : MakeTrackFinder(options);
}

// Sightings of the matched objects, the nearest ones to the two cameras.
std::vector<MatchedSightings> SightingsOf(const FrameStore& frames, const PassMap& passes,
                                          const LoopMeasurement& loop) {
  std::vector<MatchedSightings> pairs;
  for (const auto& [local, global] : loop.row.pairs) {
    const auto now = passes.NearestSighting(frames, local, frames[loop.query].travelled);
    const auto before = passes.NearestSighting(frames, global, frames[loop.match].travelled);
    if (now && before) pairs.push_back({*now, *before});
  }
  return pairs;
}

}  // namespace

LoopCloser::LoopCloser(const LoopOptions& options, const WholeMapOptions& whole_map,
                       Gallery::Mode galleries, const PlaceMatcher& matcher)
    : options_(options),
      whole_map_(whole_map),
      passes_(whole_map.noise, options.layout.split_m, galleries),
      finder_(MakeFinder(options, matcher)) {}

LoopCloser::LoopCloser(const LoopCloser& other)
    : options_(other.options_),
      whole_map_(other.whole_map_),
      passes_(other.passes_),
      finder_(other.finder_->Clone()),
      ledger_(other.ledger_),
      without_candidate_(other.without_candidate_),
      last_attempt_m_(other.last_attempt_m_),
      odometry_factors_(other.odometry_factors_),
      learnt_at_m_(other.learnt_at_m_) {}

void LoopCloser::AddKeyframe(MapState& state, double scale, TimingTable& timing) {
  const double end_m = state.frames.back().travelled;
  if (end_m - last_attempt_m_ < options_.layout.every_m) return;
  last_attempt_m_ = end_m;
  SearchAndCorrect(state, {end_m, options_.lag_m, options_.layout.local_m, 0.}, scale, timing);
}

void LoopCloser::Finish(MapState& state, double scale, TimingTable& timing) {
  if (state.frames.empty()) return;
  const LoopLayoutOptions& o = options_.layout;
  const double end_m = state.frames.back().travelled;
  for (double lag_m = options_.lag_m - o.every_m; lag_m > 0; lag_m -= o.every_m)
    if (!ledger_.AcceptedNear(state.frames, end_m - lag_m, 0.5 * o.every_m))
      SearchAndCorrect(state, {end_m, lag_m, o.local_m, options_.lag_m}, scale, timing);
  if (ledger_.AnyAccepted() && finder_->SupportsSecondSearch() && o.hindsight_m > 0)
    SearchAgain(state, scale, timing);
}

void LoopCloser::SearchAgain(MapState& state, double scale, TimingTable& timing) {
  finder_->Reset();
  const std::size_t first_search = ledger_.attempts().size();
  const int without_candidate = without_candidate_;
  const LoopLayoutOptions& o = options_.layout;
  const double lag_m = options_.lag_m;
  for (double end_m = lag_m; end_m < state.frames.back().travelled; end_m += o.every_m)
    if (!ledger_.AcceptedNear(state.frames, end_m - lag_m, 0.5 * o.every_m))
      SearchAndCorrect(state, {end_m, lag_m, o.hindsight_m, lag_m}, scale, timing);
  ledger_.DropUnaccepted(first_search);
  without_candidate_ = without_candidate;
}

void LoopCloser::SearchAndCorrect(MapState& state, const SearchWindow& window, double scale,
                                  TimingTable& timing) {
  {
    const ScopedTimer timer(timing, "loop detection");
    LearnOdometry(state, scale);
    if (!Search(state, window)) return;
  }
  const ScopedTimer timer(timing, "drift correction");
  const bool moves = !AgreesWithNewLoops(state, ledger_);
  if (moves) Correct(state, window.end_m, scale);
  FuseMatchedObjects(state, passes_, ledger_, options_.fuse_m, whole_map_);
  if (!moves) return;
  const int here = state.frames.AtPath(window.end_m);
  const Pose before = state.frames[here].T_world_cam;
  AdjustAfterLoop(state, scale, options_, whole_map_, odometry_factors_);
  finder_->MoveLocalMap(LayoutChange(before, state.frames[here].T_world_cam, state.gravity()));
}

// Learns again whenever the path has grown by a tenth.
void LoopCloser::LearnOdometry(const MapState& state, double scale) {
  constexpr double kGrowth = 1.1;
  const double path_m = state.frames.back().travelled;
  if (path_m < kGrowth * learnt_at_m_) return;
  learnt_at_m_ = path_m;
  odometry_factors_ = LearnOdometryInSight(state, passes_, options_.odometry, scale);
}

// Returns true if a loop was accepted.
bool LoopCloser::Search(const MapState& state, const SearchWindow& window) {
  const std::vector<LoopEdge> loops = ledger_.AcceptedEdges();
  const std::optional<FoundLoop> found =
      finder_->Find({state, passes_, loops, odometry_factors_, window});
  without_candidate_ += !found;
  if (!found || !ledger_.Add(*found, window, state.frames.back().frame)) return false;
  ledger_.attempts().back().pairs = SightingsOf(state.frames, passes_, found->loop);
  if (found->loop.row.decision != LoopDecision::kAccepted) return false;
  ledger_.AcceptNewest();
  return true;
}

void LoopCloser::Correct(MapState& state, double end_m, double scale) {
  const int here = state.frames.AtPath(end_m);
  const Pose before = state.frames[here].T_world_cam;
  if (!CorrectTrajectory(state, ledger_, scale, options_, whole_map_.noise, odometry_factors_))
    return;
  finder_->MoveLocalMap(LayoutChange(before, state.frames[here].T_world_cam, state.gravity()));
}

bool LoopCloser::Review(MapState& state) {
  passes_.Rebuild(state);
  finder_->Reset();  // its poses are invalid after the correction
  ReviewLoops(state, passes_, ledger_, options_, odometry_factors_);
  if (!ledger_.FusedByRefused()) return false;
  FuseMatchedObjects(state, passes_, ledger_, options_.fuse_m, whole_map_);
  return true;
}

}  // namespace sslcd
