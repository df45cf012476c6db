// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/close_loops.h"

#include <algorithm>
#include <cmath>

#include "pipeline/fuse.h"
#include "pipeline/loop_graph.h"
#include "pipeline/loop_prior.h"
#include "pipeline/move.h"
#include "pipeline/refine.h"
#include "sslcd/optim/odometry_factors.h"

namespace sslcd {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

}  // namespace

LoopCloser::LoopCloser(const Options& options, ObjectMap& map, std::vector<FrameRecord>& frames,
                       PlaceMatcher matcher)
    : options_(options),
      map_(map),
      frames_(frames),
      matcher_(std::move(matcher)),
      passes_(map, frames, options.noise, options.loop.layout.split_m,
              options.mode == Options::Mode::kPaper ? Gallery::Mode::kMean
                                                    : Gallery::Mode::kByViewpoint),
      tracks_(options.loop.tracks) {}

std::vector<LoopClosure> LoopCloser::closures() const {
  std::vector<LoopClosure> rows;
  for (const Attempt& attempt : attempts_) {
    LoopClosure& row = rows.emplace_back(attempt.loop.row);
    if (!attempt.anew || row.decision != LoopDecision::kAccepted) continue;
    row.T_match_query = attempt.anew->T_match_query;
    row.covariance = attempt.anew->covariance;
    row.viewpoint_change_rad = attempt.anew->viewpoint_change_rad;
    row.by_views = attempt.anew->by_views;
  }
  return rows;
}

bool LoopCloser::Closed() const {
  return std::any_of(attempts_.begin(), attempts_.end(), [](const Attempt& attempt) {
    return attempt.loop.row.decision == LoopDecision::kAccepted;
  });
}

PathGraph LoopCloser::Path() const {
  PathGraph path;
  for (const Attempt& attempt : attempts_)
    if (attempt.loop.row.decision == LoopDecision::kAccepted)
      path.AddShortcut(frames_[attempt.loop.query].travelled,
                       frames_[attempt.loop.match].travelled);
  return path;
}

bool LoopCloser::AddKeyframe(double scale, TimingTable& timing) {
  const LoopLayoutOptions& o = options_.loop.layout;
  if (frames_.back().travelled - last_attempt_m_ < o.every_m) return false;
  last_attempt_m_ = frames_.back().travelled;
  return DetectAndCorrect({last_attempt_m_, options_.loop.lag_m, o.local_m, 0.}, scale, timing);
}

void LoopCloser::Finish(double scale, TimingTable& timing) {
  if (frames_.empty() || options_.mode == Options::Mode::kPaper) return;
  const LoopOptions& o = options_.loop;
  for (double lag = o.lag_m - o.layout.every_m; lag > 0; lag -= o.layout.every_m)
    if (!ClosedNear(frames_.back().travelled - lag))
      DetectAndCorrect({frames_.back().travelled, lag, o.layout.local_m, o.lag_m}, scale, timing);
  if (Closed() && !matcher_ && o.layout.hindsight_m > 0) LookAgain(scale, timing);
}

bool LoopCloser::DetectAndCorrect(const Look& look, double scale, TimingTable& timing) {
  {
    const ScopedTimer timer(timing, "loop detection");
    if (!Find(look)) return false;
  }
  const ScopedTimer timer(timing, "drift correction");
  const bool moved = !Agree();
  if (moved) Correct(look.here_m, scale);
  const bool fused = Fuse();
  if (moved && options_.mode != Options::Mode::kPaper) {
    const int here = FrameAt(look.here_m);
    const Pose before = frames_[here].T_world_cam;
    OptimiseAfterLoop(map_, frames_, scale, options_);
    passes_.MovedFrom(0);
    tracks_.Move(LayoutChange(before, frames_[here].T_world_cam, map_.gravity()));
  }
  return moved || fused;
}

int LoopCloser::FrameAt(double path_m) const {
  const auto at =
      std::lower_bound(frames_.begin(), frames_.end(), path_m,
                       [](const FrameRecord& frame, double m) { return frame.travelled < m; });
  return static_cast<int>(std::min(at, frames_.end() - 1) - frames_.begin());
}

bool LoopCloser::ClosedNear(double path_m) const {
  return std::any_of(attempts_.begin(), attempts_.end(), [&](const Attempt& attempt) {
    return attempt.loop.row.decision == LoopDecision::kAccepted &&
           std::abs(frames_[attempt.loop.query].travelled - path_m) <
               0.5 * options_.loop.layout.every_m;
  });
}

// Has the newest frame led to these two cameras before?
bool LoopCloser::Known(const LoopMeasurement& loop) const {
  return std::any_of(attempts_.begin(), attempts_.end(), [&](const Attempt& attempt) {
    return attempt.loop.query == loop.query && attempt.loop.match == loop.match &&
           attempt.loop.row.newest_frame == frames_.back().frame;
  });
}

// What was missed at first for want of evidence is found where a later loop has made the trajectory
// right: the prior is narrow there, and few objects suffice. Only what is believed becomes an
// attempt.
void LoopCloser::LookAgain(double scale, TimingTable& timing) {
  path_ = Path();
  tracks_.Forget();
  const std::size_t first_looks = attempts_.size();
  const LoopOptions& o = options_.loop;
  for (double here = o.lag_m; here < frames_.back().travelled; here += o.layout.every_m)
    if (!ClosedNear(here - o.lag_m))
      DetectAndCorrect({here, o.lag_m, o.layout.hindsight_m, o.lag_m}, scale, timing);
  attempts_.erase(
      std::remove_if(attempts_.begin() + static_cast<std::ptrdiff_t>(first_looks), attempts_.end(),
                     [](const Attempt& attempt) { return !attempt.believed; }),
      attempts_.end());
}

// True: something new is believed.
bool LoopCloser::Find(const Look& look) {
  if (matcher_) return DetectWithMatcher(look);
  return options_.mode == Options::Mode::kPaper ? DetectAsPrinted() : Detect(look);
}

// The global map, kept from attempt to attempt.
const LayoutIndex& LoopCloser::OldMap(double old_until_m) {
  const LoopOptions& o = options_.loop;
  LayoutChanges changes = passes_.ChangesBefore(old_until_m, o.layout.min_sightings);
  if (!old_ || changes.anew)
    old_.emplace(std::move(changes.objects), o.match.max_pair_m, o.match.reach_m);
  else
    old_->Update(changes.objects, changes.gone);
  return *old_;
}

bool LoopCloser::Detect(const Look& look) {
  const LoopOptions& o = options_.loop;
  const double old_until = look.OldUntil(o.layout.gap_m);
  const PassLayout local =
      passes_.Between(look.here_m - look.local_m, look.here_m, o.layout.min_sightings);
  const LayoutIndex& index = OldMap(old_until);
  const int few = o.match.search.min_matches;
  if (static_cast<int>(std::min(local.objects.size(), index.objects().size())) < few) return false;

  const LayoutLikelihood likelihood(local.objects, index, o.match.likelihood);
  // the tracks of earlier attempts need not be found again
  PoseSearchOptions search = o.match.search;
  search.refine = std::min(search.refine, o.tracks.max_tracks);
  std::vector<PoseHypothesis> found = SearchPoses(likelihood, search);
  PoseHypothesis as_believed;  // the camera may be where it believes to be
  as_believed.fit = likelihood.Refine(as_believed.pose, 4);
  if (static_cast<int>(as_believed.fit.matches.size()) >= few)
    found.insert(found.begin(), as_believed);
  tracks_.Update(likelihood, found, search, look.here_m,
                 OdometryPrior(passes_, path_.From(look.here_m), local, index, o.prior));
  if (tracks_.tracks().empty()) return false;

  const PoseTrack& best = tracks_.tracks()[0];
  const CommonObjects common{local, OldLandmarks(best.fit.matches, index), best.fit.sigma,
                             old_until};
  auto loop = Meter().Measure(common, look.here_m - look.lag_m, look.beyond_m);
  if (!loop || Known(*loop)) return false;
  Attempt& attempt = AddAttempt(std::move(*loop));
  attempt.look = look;
  attempt.sigma_m = common.sigma_m;
  attempt.track = best.id;
  // The evidence is against poses anywhere on the map; the track leaves about this much of them.
  constexpr double kTrackVolume = 2.5;  // [m^2 rad]
  const double searched = 2 * M_PI * static_cast<double>(index.objects().size()) / index.density();
  return Judge(best, best.fit.evidence + std::log(searched / kTrackVolume), attempt);
}

// Believes an attempt, and with it the earlier ones of its track - or says why not.
bool LoopCloser::Judge(const PoseTrack& best, double own_evidence, Attempt& attempt) {
  const LoopBeliefOptions& o = options_.loop.belief;
  LoopClosure& row = attempt.loop.row;
  row.score = tracks_.Margin(0);
  row.second_score = tracks_.tracks().size() > 1 ? tracks_.Margin(1) : -row.score;
  row.decision = best.evidence < 0 ? LoopDecision::kNone : LoopDecision::kAmbiguous;
  std::string weakness;
  if (own_evidence < o.min_own_evidence)
    weakness = "too few objects of its own agree";
  else if (attempt.loop.heading_sigma >= o.max_heading_sigma_rad)
    weakness = "heading too uncertain";
  else if (row.T_match_query.translation().norm() >= o.max_apart_m)
    weakness = "no old camera stood near";
  attempt.confirmed = weakness.empty();
  if (best.evidence < 0)
    row.reason = "chance explains the best pose";
  else if (row.score < o.min_margin)
    row.reason = "another pose fits nearly as well";
  else
    row.reason = weakness;
  if (!attempt.confirmed || row.score < o.min_margin) return false;

  for (Attempt& earlier : attempts_)
    if (earlier.track == attempt.track && earlier.confirmed && !earlier.believed)
      Believe(earlier, "settled by frame " + std::to_string(row.query_frame));
  Believe(attempt, std::to_string(row.pairs.size()) + " objects agree");
  return true;
}

void LoopCloser::Believe(Attempt& attempt, const std::string& reason) {
  attempt.believed = true;
  attempt.loop.row.decision = LoopDecision::kAccepted;
  attempt.loop.row.reason = reason;
  path_.AddShortcut(frames_[attempt.loop.query].travelled, frames_[attempt.loop.match].travelled);
}

LoopCloser::Attempt& LoopCloser::AddAttempt(LoopMeasurement loop) {
  Attempt& attempt = attempts_.emplace_back();
  attempt.loop = std::move(loop);
  attempt.loop.row.newest_frame = frames_.back().frame;
  attempt.pairs = attempt.loop.row.pairs;
  return attempt;
}

// True if the trajectory as it stands goes through all loops believed since the last correction.
bool LoopCloser::Agree() const {
  const double limit = Chi2Quantile(0.9, 6);
  return std::all_of(attempts_.begin(), attempts_.end(), [&](const Attempt& attempt) {
    if (!attempt.believed || attempt.in_graph) return true;
    const LoopClosure& row = attempt.loop.row;
    const Pose T =
        frames_[attempt.loop.match].T_world_cam.inverse() * frames_[attempt.loop.query].T_world_cam;
    const Vec6 error = (row.T_match_query.inverse() * T).Log();
    return error.dot(Mat6(row.covariance).ldlt().solve(error)) < limit;
  });
}

// Solves the pose graph with all loops ever believed, which decides anew about each of them, and
// moves trajectory and map.
void LoopCloser::Correct(double here_m, double scale) {
  std::vector<Attempt*> loops;
  std::vector<LoopEdge> edges;
  for (Attempt& attempt : attempts_) {
    if (!attempt.believed) continue;
    attempt.in_graph = true;
    loops.push_back(&attempt);
    edges.push_back({attempt.loop.match, attempt.loop.query, &attempt.loop.row});
  }
  LoopGraph graph = BuildLoopGraph(frames_, edges, scale, map_.gravity().up, options_.loop);
  if (options_.mode == Options::Mode::kPaper) {
    if (!SolvePoseGraph(graph.graph, options_.loop.graph.graph).usable) return;
  } else {
    const RobustPoseGraphSummary summary =
        SolveRobust(graph.graph, options_.loop.graph, graph.kept_before);
    if (!summary.graph.usable) return;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const bool kept = summary.edge_weight[graph.first_loop + i] > 0;
      LoopClosure& row = loops[i]->loop.row;
      if (kept && row.decision != LoopDecision::kAccepted)
        row.reason = "other loops agree after all";
      if (!kept) row.reason = "contradicts other loops";
      row.decision = kept ? LoopDecision::kAccepted : LoopDecision::kAmbiguous;
    }
  }
  const std::vector<Pose> before = PosesOf(frames_);
  MoveKeyframes(frames_, graph.keyframes, PosesOf(graph.graph));
  MoveObjects(map_, frames_, before, options_.noise);
  passes_.MovedFrom(0);
  const int here = FrameAt(here_m);
  tracks_.Move(LayoutChange(before[here], frames_[here].T_world_cam, map_.gravity()));
}

// What was matched becomes one landmark.
bool LoopCloser::Fuse() {
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;
  const auto& all = map_.landmarks();
  for (const Attempt& attempt : attempts_) {
    if (attempt.loop.row.decision != LoopDecision::kAccepted) continue;
    for (const auto& [local, global] : attempt.pairs) {
      const auto a = all.find(local.value), b = all.find(global.value);
      if (local == global || a == all.end() || b == all.end()) continue;
      if ((a->second.pose.position - b->second.pose.position).norm() <= options_.loop.fuse_m)
        pairs.push_back({global, local});
    }
  }
  if (pairs.empty()) return false;
  const Heirs heirs = FuseMatched(map_, frames_, pairs, options_);
  if (heirs.empty()) return false;
  passes_.Rename(heirs);
  for (Attempt& attempt : attempts_)
    for (auto& [local, global] : attempt.pairs)
      local = HeirOf(local, heirs), global = HeirOf(global, heirs);
  return true;
}

OdometryFactors LoopCloser::LearnOdometry(double scale) const {
  std::vector<LoopEdge> edges;
  for (const Attempt& attempt : attempts_)
    if (attempt.loop.row.decision == LoopDecision::kAccepted)
      edges.push_back({attempt.loop.match, attempt.loop.query, &attempt.loop.row});
  if (!options_.loop.learn_odometry || options_.mode == Options::Mode::kPaper) return {};
  const Vec3 up = map_.gravity().up;
  return LearnOdometryFactors(BuildLoopGraph(frames_, edges, scale, up, options_.loop).graph, up);
}

void LoopCloser::Review() {
  passes_.Rebuild();
  tracks_.Forget();  // where they were everything has moved
  if (options_.mode == Options::Mode::kPaper) return;
  const LoopBeliefOptions& o = options_.loop.belief;
  for (Attempt& attempt : attempts_) {
    LoopClosure& row = attempt.loop.row;
    if (row.decision != LoopDecision::kAccepted) continue;
    const Pose T =
        frames_[attempt.loop.match].T_world_cam.inverse() * frames_[attempt.loop.query].T_world_cam;
    const Pose error = row.T_match_query.inverse() * T;
    if (error.translation().norm() < o.probation_m && error.so3().Log().norm() < o.probation_rad) {
      MeasureAnew(attempt);
      continue;
    }
    row.decision = LoopDecision::kAmbiguous;
    row.reason = "the refined trajectory disagrees";
  }
}

// At first the two maps were bent by the odometry between their objects. They are not any more, and
// what was seen on both passes is one landmark. For the host only: this loop itself has
// straightened them, so what decides about it remains what was measured at first.
void LoopCloser::MeasureAnew(Attempt& attempt) const {
  attempt.anew.reset();
  if (attempt.sigma_m <= 0) return;
  const LoopLayoutOptions& o = options_.loop.layout;
  const Look& look = attempt.look;
  const PassLayout local =
      passes_.Between(look.here_m - look.local_m, look.here_m, o.min_sightings);
  CommonObjects common{local, {}, attempt.sigma_m, look.OldUntil(o.gap_m)};
  for (std::size_t i = 0; i < local.objects.size(); ++i) {
    const LandmarkId id{local.objects[i].id};
    if (passes_.PlaceBefore(id, common.old_until_m, o.min_sightings))
      common.pairs.push_back({static_cast<int>(i), id});
  }
  auto now = Meter().MeasureBetween(attempt.loop.query, attempt.loop.match, common);
  if (now && now->heading_sigma < options_.loop.belief.max_heading_sigma_rad)
    attempt.anew = std::move(now->row);
}

}  // namespace sslcd
