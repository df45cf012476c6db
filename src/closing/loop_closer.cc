// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_closer.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "closing/loop_corrector.h"
#include "closing/parts.h"
#include "closing/remeasure.h"
#include "closing/resightings.h"

namespace sslcd {
namespace {

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

std::unique_ptr<LoopFinder> MakeFinder(const LoopOptions& options, const PlaceMatcher& matcher) {
  if (matcher) return MakeHostFinder(options, matcher);
  return options.finder == LoopOptions::Finder::kPrinted ? MakePrintedFinder(options)
                                                         : MakeTrackFinder(options);
}

LoopCloser::LoopCloser(const LoopOptions& options, const WholeMapOptions& whole_map,
                       Gallery::Mode galleries, std::unique_ptr<LoopFinder> finder)
    : options_(options),
      whole_map_(whole_map),
      passes_(whole_map.noise, options.layout.split_m, galleries),
      first_{std::move(finder)},
      second_{first_.finder->Clone()} {}

LoopCloser::LoopCloser(const LoopCloser& other)
    : options_(other.options_),
      whole_map_(other.whole_map_),
      passes_(other.passes_),
      first_{other.first_.finder->Clone(), other.first_.end_m},
      second_{other.second_.finder->Clone(), other.second_.end_m},
      ledger_(other.ledger_),
      without_candidate_(other.without_candidate_),
      look_back_(other.look_back_),
      last_place_(other.last_place_),
      last_attempt_m_(other.last_attempt_m_),
      odometry_factors_(other.odometry_factors_),
      learnt_at_m_(other.learnt_at_m_) {}

void LoopCloser::AddKeyframe(MapState& state, double scale, TimingTable& timing) {
  const double end_m = state.frames.back().travelled;
  if (end_m - last_attempt_m_ < options_.layout.every_m) return;
  last_attempt_m_ = end_m;
  SearchNow(state, scale, timing);
  LookBack(state, scale, timing);
  ledger_.DropEarly(state.frames, end_m - options_.lag_m + 0.5 * options_.layout.every_m);
}

void LoopCloser::SearchNow(MapState& state, double scale, TimingTable& timing) {
  SearchAndCorrect(state,
                   {state.frames.back().travelled, options_.lag_m, options_.layout.local_m, 0.},
                   scale, timing);
}

void LoopCloser::SearchAtEnd(MapState& state, double scale, TimingTable& timing) {
  if (state.frames.empty()) return;
  const LoopLayoutOptions& o = options_.layout;
  const double end_m = state.frames.back().travelled;
  ledger_.DropEarly(state.frames, std::numeric_limits<double>::infinity());
  for (double lag_m = options_.lag_m - o.every_m; lag_m > 0; lag_m -= o.every_m)
    if (!ledger_.AcceptedNear(state.frames, end_m - lag_m, 0.5 * o.every_m))
      SearchAndCorrect(state, {end_m, lag_m, o.local_m, options_.lag_m}, scale, timing);
}

bool LoopCloser::SearchesTwice() const {
  return second_.finder->SupportsSecondSearch() && options_.layout.hindsight_m > 0;
}

// Whether there is any path before the local map of a second search.
bool LoopCloser::HasOldMap(int place) const {
  return SecondWindow(place).GlobalMapEnd(options_.layout.gap_m) > 0;
}

// The second search from the camera at `place` times the path between attempts.
SearchWindow LoopCloser::SecondWindow(int place) const {
  const LoopLayoutOptions& o = options_.layout;
  const double lag_m = options_.lag_m;
  return {lag_m + place * o.every_m, lag_m, o.hindsight_m, lag_m, true};
}

void LoopCloser::SearchAgain(MapState& state, double scale, TimingTable& timing) {
  if (!ledger_.AnyAccepted() || !SearchesTwice()) return;
  second_.finder->Reset();
  const int without_candidate = without_candidate_;
  for (int place = 0;; ++place) {
    const SearchWindow window = SecondWindow(place);
    if (window.end_m >= state.frames.back().travelled) break;
    if (IsLostAt(state.frames, window.end_m - window.lag_m)) continue;
    if (!ledger_.AcceptedNear(state.frames, window.end_m - window.lag_m,
                              0.5 * options_.layout.every_m))
      SearchAndCorrect(state, window, scale, timing);
  }
  ledger_.DropUnacceptedOfSecond();
  without_candidate_ = without_candidate;
  look_back_.clear();
}

// Some second searches, along the path as far as places follow each other.
void LoopCloser::LookBack(MapState& state, double scale, TimingTable& timing) {
  const int without_candidate = without_candidate_;
  for (int left = options_.layout.look_back; left > 0 && !look_back_.empty();) {
    auto next = look_back_.find(last_place_ + 1);
    if (next == look_back_.end()) {
      next = look_back_.begin();
      second_.finder->Reset();
      ledger_.DropUnacceptedOfSecond();
    }
    last_place_ = *next;
    look_back_.erase(next);
    const SearchWindow window = SecondWindow(last_place_);
    if (ledger_.AcceptedNear(state.frames, window.end_m - window.lag_m,
                             0.5 * options_.layout.every_m))
      continue;
    SearchAndCorrect(state, window, scale, timing);
    --left;
  }
  without_candidate_ = without_candidate;
}

// Plans second searches near a camera whose loop was accepted: the prior is narrow there now.
void LoopCloser::LookBackNear(const FrameStore& frames, double path_m) {
  constexpr double kNear = 100;  // set by hand [m]
  if (!SearchesTwice()) return;
  const double every_m = options_.layout.every_m;
  const int last = static_cast<int>((path_m + kNear) / every_m);
  for (int place = std::max(0, static_cast<int>((path_m - kNear) / every_m));
       place <= last && SecondWindow(place).end_m < frames.back().travelled; ++place)
    if (HasOldMap(place) && !IsLostAt(frames, place * every_m)) look_back_.insert(place);
}

void LoopCloser::SearchAndCorrect(MapState& state, const SearchWindow& window, double scale,
                                  TimingTable& timing) {
  (window.second ? second_ : first_).end_m = window.end_m;
  {
    const ScopedTimer timer(timing, "loop detection");
    // again whenever the path has grown by a tenth
    if (state.frames.back().travelled >= 1.1 * learnt_at_m_) LearnFromSight(state, scale);
    if (!Search(state, window)) return;
  }
  const ScopedTimer timer(timing, "drift correction");
  const bool moves = !AgreesWithNewLoops(state, ledger_);
  std::vector<Pose> before = EndsOfLooks(state.frames);
  const bool placed = PlaceJoined(state);
  const bool solved = moves && CorrectTrajectory(state, ledger_, scale, options_, whole_map_.noise,
                                                 odometry_factors_);
  if (placed || solved) MoveLooks(before, state);
  FuseMatchedObjects(state, passes_, ledger_, options_.fuse_m, whole_map_);
  if (!moves) return;
  before = EndsOfLooks(state.frames);
  AdjustAfterLoop(state, scale, options_, whole_map_, odometry_factors_);
  MoveLooks(before, state);
}

// Places the parts that loops of this search join. False: there are none.
bool LoopCloser::PlaceJoined(MapState& state) const {
  if (state.frames.parts().size() < 2) return false;
  const FrameStore::Revision revision = state.frames.revision();
  std::vector<LoopEdge> known, found;
  for (const LoopAttempt& attempt : ledger_.attempts())
    if (attempt.accepted())
      (attempt.solved ? known : found)
          .push_back({attempt.found.loop.match, attempt.found.loop.query, &attempt.row()});
  PlaceParts(state, std::move(known), found, whole_map_.noise);
  return state.frames.revision() != revision;
}

std::vector<Pose> LoopCloser::EndsOfLooks(const FrameStore& frames) const {
  return {frames[frames.AtPath(first_.end_m)].T_world_cam,
          frames[frames.AtPath(second_.end_m)].T_world_cam};
}

void LoopCloser::MoveLooks(const std::vector<Pose>& before, const MapState& state) {
  const std::vector<Pose> now = EndsOfLooks(state.frames);
  first_.finder->MoveLocalMap(LayoutChange(before[0], now[0], state.gravity()));
  second_.finder->MoveLocalMap(LayoutChange(before[1], now[1], state.gravity()));
}

void LoopCloser::LearnFromSight(const MapState& state, double scale) {
  learnt_at_m_ = state.frames.back().travelled;
  odometry_factors_ =
      LearnOdometryInSight(state, passes_, options_.odometry, scale, odometry_factors_);
}

// Returns true if a loop was accepted.
bool LoopCloser::Search(const MapState& state, const SearchWindow& window) {
  const std::vector<LoopEdge> loops = ledger_.AcceptedEdges();
  std::optional<FoundLoop> found = (window.second ? second_ : first_)
                                       .finder->Find({state, passes_, loops, odometry_factors_,
                                                      window, EarlyPlaces(state.frames, window)});
  without_candidate_ += !found;
  if (!found) return false;
  const std::vector<FoundLoop> early = std::exchange(found->early, {});
  if (!ledger_.Add(*found, window, state.frames.back().frame)) return false;
  ledger_.attempts().back().pairs = SightingsOf(state.frames, passes_, found->loop);
  if (found->loop.row.decision != LoopDecision::kAccepted) return false;
  ledger_.AcceptNewest();
  AddEarly(state.frames, window, early);
  LookBackNear(state.frames, state.frames[found->loop.query].travelled);
  return true;
}

// Path lengths of later cameras that have no loop yet. None for a search that is no camera's first.
std::vector<double> LoopCloser::EarlyPlaces(const FrameStore& frames,
                                            const SearchWindow& window) const {
  std::vector<double> places;
  if (window.second || window.lag_m < options_.lag_m) return places;
  const double every_m = options_.layout.every_m;
  for (double lag_m = options_.lag_m - every_m; lag_m > 0; lag_m -= every_m) {
    const double path_m = window.end_m - lag_m;
    if (!ledger_.AnyLoopNear(frames, path_m, 0.5 * every_m)) places.push_back(path_m);
  }
  return places;
}

// Where the heading was uncertain, another camera than the wanted one was measured.
void LoopCloser::AddEarly(const FrameStore& frames, const SearchWindow& window,
                          const std::vector<FoundLoop>& found) {
  const double near_m = 0.5 * options_.layout.every_m;
  for (const FoundLoop& early : found) {
    const double path_m = frames[early.loop.query].travelled;
    if (path_m > window.end_m - window.lag_m + near_m &&
        !ledger_.AnyLoopNear(frames, path_m, near_m))
      ledger_.AddEarly(early, frames.back().frame);
  }
}

bool LoopCloser::Review(MapState& state) {
  passes_.Rebuild(state);
  // poses of tracks are invalid after the correction
  first_.finder->Reset();
  second_.finder->Reset();
  ReviewLoops(state, passes_, ledger_, options_, odometry_factors_);
  ledger_.DropEarly(state.frames, 0);
  if (!ledger_.FusedByRefused()) return false;
  FuseMatchedObjects(state, passes_, ledger_, options_.fuse_m, whole_map_);
  return true;
}

}  // namespace sslcd
