// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/close_loops.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/fuse.h"
#include "pipeline/loop_graph.h"
#include "pipeline/loop_prior.h"
#include "pipeline/move.h"
#include "pipeline/refine.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

void CheckMatches(const std::vector<std::pair<int, int>>& matches, std::size_t locals, std::size_t globals) {
  for (const auto& [i, j] : matches)
    if (i < 0 || j < 0 || i >= static_cast<int>(locals) || j >= static_cast<int>(globals))
      throw Error(ErrorKind::kUsage, "the place matcher matches objects " + std::to_string(i) + " and " +
                                         std::to_string(j) + " of " + std::to_string(locals) + " local and " +
                                         std::to_string(globals) + " global ones");
}

}  // namespace

LoopCloser::LoopCloser(const Options& options, ObjectMap& map, std::vector<FrameRecord>& frames, PlaceMatcher matcher)
    : options_(options),
      map_(map),
      frames_(frames),
      matcher_(std::move(matcher)),
      passes_(map, frames, options.noise, options.loop.layout.split_m,
              options.mode == Options::Mode::kPaper ? Gallery::Mode::kMean : Gallery::Mode::kByViewpoint),
      tracks_(options.loop.tracks) {}

std::vector<LoopClosure> LoopCloser::closures() const {
  std::vector<LoopClosure> rows;
  for (const Attempt& attempt : attempts_) rows.push_back(attempt.loop.row);
  return rows;
}

bool LoopCloser::Closed() const {
  return std::any_of(attempts_.begin(), attempts_.end(),
                     [](const Attempt& attempt) { return attempt.loop.row.decision == LoopDecision::kAccepted; });
}

bool LoopCloser::AddKeyframe(double scale, TimingTable& timing) {
  const LoopLayoutOptions& o = options_.loop.layout;
  if (frames_.back().travelled - last_attempt_m_ < o.every_m) return false;
  last_attempt_m_ = frames_.back().travelled;
  return DetectAndCorrect({last_attempt_m_, options_.loop.lag_m, o.local_m, 0.}, scale, timing);
}

void LoopCloser::Finish(double scale, TimingTable& timing) {
  constexpr double kStep = 10.;  // [m]
  if (frames_.empty() || options_.mode == Options::Mode::kPaper || matcher_) return;
  const LoopOptions& o = options_.loop;
  for (double lag = o.lag_m - kStep; lag > 0; lag -= kStep)
    DetectAndCorrect({frames_.back().travelled, lag, o.layout.local_m, o.lag_m}, scale, timing);
  if (Closed()) LookAgain(scale, timing);
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
    tracks_.Move(LayoutChange(before, frames_[here].T_world_cam, map_.gravity()));
  }
  return moved || fused;
}

int LoopCloser::FrameAt(double path_m) const {
  const auto at = std::lower_bound(frames_.begin(), frames_.end(), path_m,
                                   [](const FrameRecord& frame, double m) { return frame.travelled < m; });
  return static_cast<int>(std::min(at, frames_.end() - 1) - frames_.begin());
}

bool LoopCloser::ClosedNear(double path_m) const {
  return std::any_of(attempts_.begin(), attempts_.end(), [&](const Attempt& attempt) {
    return attempt.loop.row.decision == LoopDecision::kAccepted &&
           std::abs(frames_[attempt.loop.query].travelled - path_m) < 0.5 * options_.loop.layout.every_m;
  });
}

// What was missed at first for want of evidence is found where a later loop has made the trajectory right: the prior is
// narrow there, and few objects suffice. Only what is believed becomes an attempt.
void LoopCloser::LookAgain(double scale, TimingTable& timing) {
  path_ = {};
  for (const Attempt& attempt : attempts_)
    if (attempt.loop.row.decision == LoopDecision::kAccepted)
      path_.AddShortcut(frames_[attempt.loop.query].travelled, frames_[attempt.loop.match].travelled);
  tracks_.Forget();
  const std::size_t first_looks = attempts_.size();
  const LoopOptions& o = options_.loop;
  for (double here = o.lag_m; here < frames_.back().travelled; here += o.layout.every_m)
    if (!ClosedNear(here - o.lag_m)) DetectAndCorrect({here, o.lag_m, o.layout.hindsight_m, o.lag_m}, scale, timing);
  attempts_.erase(std::remove_if(attempts_.begin() + static_cast<std::ptrdiff_t>(first_looks), attempts_.end(),
                                 [](const Attempt& attempt) { return !attempt.believed; }),
                  attempts_.end());
}

// True: something new is believed.
bool LoopCloser::Find(const Look& look) {
  if (matcher_) return DetectWithMatcher();
  return options_.mode == Options::Mode::kPaper ? DetectAsPrinted() : Detect(look);
}

bool LoopCloser::Detect(const Look& look) {
  const LoopOptions& o = options_.loop;
  const double old_until = look.OldUntil(o.layout.gap_m);
  const PassLayout local = passes_.Between(look.here_m - look.local_m, look.here_m, o.layout.min_sightings);
  const PassLayout global = passes_.Before(old_until, o.layout.min_sightings);
  const int few = o.match.search.min_matches;
  if (static_cast<int>(std::min(local.objects.size(), global.objects.size())) < few) return false;

  const LayoutIndex index(global.objects, o.match.max_pair_m, o.match.reach_m);
  const LayoutLikelihood likelihood(local.objects, index, o.match.likelihood);
  PoseSearchOptions search = o.match.search;  // the tracks of earlier attempts need not be found again
  search.refine = std::min(search.refine, o.tracks.max_tracks);
  std::vector<PoseHypothesis> found = SearchPoses(likelihood, search);
  PoseHypothesis as_believed;  // the camera may be where it believes to be
  as_believed.fit = likelihood.Refine(as_believed.pose, 4);
  if (static_cast<int>(as_believed.fit.matches.size()) >= few) found.insert(found.begin(), as_believed);
  tracks_.Update(likelihood, found, search, look.here_m,
                 OdometryPrior(passes_, path_.From(look.here_m), local, global, index, o.prior));
  if (tracks_.tracks().empty()) return false;

  const PoseTrack& best = tracks_.tracks()[0];
  const LoopMeter meter(map_.gravity(), frames_, passes_, o);
  auto loop = meter.Measure(local, global, best.fit.matches, best.fit.sigma, look.here_m - look.lag_m, old_until,
                            look.beyond_m);
  if (!loop) return false;
  Attempt& attempt = AddAttempt(std::move(*loop));
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

// The two-stage matching, the drift and the loop frame of mode: paper (IV-B to IV-D), which knows no refusal. The loop
// frame is the first one that saw any of the matched objects; the newest camera, moved by the printed T_drift, is tied
// to it.
bool LoopCloser::DetectAsPrinted() {
  const LoopLayoutOptions& o = options_.loop.layout;
  const double local_from = frames_.back().travelled - o.local_m;
  PassLayout local = passes_.Recent(local_from, o.min_sightings);
  PassLayout global = passes_.Before(local_from - o.gap_m, o.min_sightings);
  for (PassLayout* layout : {&local, &global})
    for (std::size_t i = 0; i < layout->objects.size(); ++i)
      layout->objects[i].position = map_.gravity().Basis().transpose() * layout->places[i].position;
  const auto matches = PaperMatch(local.objects, global.objects, options_.loop.paper);
  if (!matches) return false;
  LoopMeasurement loop;
  LoopClosure& row = loop.row;
  std::vector<DriftPair> pairs;
  loop.query = static_cast<int>(frames_.size()) - 1;
  loop.match = loop.query;
  for (const ObjectMatch& match : *matches) {
    DriftPair& pair = pairs.emplace_back();
    pair.T_world_local = ToPose(local.places[match.local], map_.gravity());
    pair.T_world_global = ToPose(global.places[match.global], map_.gravity());
    row.pairs.push_back({{local.objects[match.local].id}, {global.objects[match.global].id}});
    row.score += match.similarity;
    for (const PassObject& pass : passes_.passes())
      if (pass.id == row.pairs.back().second) loop.match = std::min(loop.match, pass.sightings.front().first);
  }
  const std::optional<Pose> T_drift = SolveDriftAsPrinted(pairs);
  if (!T_drift || loop.match == loop.query) return false;
  const FrameRecord &query = frames_[loop.query], &match = frames_[loop.match];
  row.query_frame = query.frame;
  row.match_frame = match.frame;
  row.T_match_query = match.T_world_cam.inverse() * T_drift->inverse() * query.T_world_cam;  // Eq. 19
  row.covariance = Mat6::Identity() * 0.01;                                                  // none is printed: tight
  Believe(AddAttempt(std::move(loop)), "as printed: " + std::to_string(pairs.size()) + " objects match");
  return true;
}

// A matcher of the host finds the place and decides; drift, pose graph and map are ours.
bool LoopCloser::DetectWithMatcher() {
  const LoopLayoutOptions& o = options_.loop.layout;
  const double here = frames_.back().travelled, local_from = here - o.local_m, old_until = local_from - o.gap_m;
  const PassLayout local = passes_.Recent(local_from, o.min_sightings);
  const PassLayout global = passes_.Before(old_until, o.min_sightings);
  const auto old_end = std::upper_bound(frames_.begin(), frames_.end(), old_until,
                                        [](double m, const FrameRecord& frame) { return m < frame.travelled; });
  if (old_end == frames_.begin()) return false;
  const auto answer = matcher_({local.objects, global.objects, frames_.back().frame, std::prev(old_end)->frame});
  if (!answer) return false;
  std::optional<LoopMeasurement> loop;
  if (answer->matches.empty()) {
    loop = MeasureImages(answer->match_frame, answer->T_match_query);
  } else {
    constexpr double kSigma = 0.3;  // of matched objects; a matcher does not say how well they agree [m]
    CheckMatches(answer->matches, local.objects.size(), global.objects.size());
    const LoopMeter meter(map_.gravity(), frames_, passes_, options_.loop);
    loop = meter.Measure(local, global, answer->matches, kSigma, here - options_.loop.lag_m, old_until, 0.);
  }
  if (!loop) return false;
  Attempt& attempt = AddAttempt(std::move(*loop));
  LoopClosure& row = attempt.loop.row;
  row.score = answer->score;
  row.decision = LoopDecision::kAmbiguous;
  row.reason = "the matcher is not sure";
  if (answer->accepted) Believe(attempt, "the matcher is sure");
  return answer->accepted;
}

// Two images tie two cameras together: the newest one and an old one.
LoopMeasurement LoopCloser::MeasureImages(int match_frame, const Pose& T_match_query) const {
  const auto match = std::find_if(frames_.begin(), frames_.end(),
                                  [&](const FrameRecord& frame) { return frame.frame == match_frame; });
  if (match == frames_.end())
    throw Error(ErrorKind::kUsage, "the place matcher answers with frame " + std::to_string(match_frame) +
                                       ", which has not been seen; name one up to PlaceQuery::old_frame");
  LoopMeasurement loop;
  loop.query = static_cast<int>(frames_.size()) - 1;
  loop.match = static_cast<int>(match - frames_.begin());
  LoopClosure& row = loop.row;
  row.query_frame = frames_.back().frame;
  row.match_frame = match_frame;
  row.T_match_query = T_match_query;
  Vec6 sigmas;
  sigmas << Vec3::Constant(options_.loop.sigma_m), Vec3::Constant(options_.loop.sigma_rad);
  row.covariance = Mat6(sigmas.cwiseAbs2().asDiagonal());
  const LoopMeter meter(map_.gravity(), frames_, passes_, options_.loop);
  row.viewpoint_change_rad =
      std::abs(WrapAngle(meter.Heading(match->T_world_cam * T_match_query) - meter.Heading(match->T_world_cam)));
  return loop;
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
    const Pose T = frames_[attempt.loop.match].T_world_cam.inverse() * frames_[attempt.loop.query].T_world_cam;
    const Vec6 error = (row.T_match_query.inverse() * T).Log();
    return error.dot(Mat6(row.covariance).ldlt().solve(error)) < limit;
  });
}

// Solves the pose graph with all loops ever believed, which decides anew about each of them, and moves trajectory and
// map.
void LoopCloser::Correct(double here_m, double scale) {
  std::vector<Attempt*> loops;
  std::vector<LoopEdge> edges;
  for (Attempt& attempt : attempts_) {
    if (!attempt.believed) continue;
    attempt.in_graph = true;
    loops.push_back(&attempt);
    edges.push_back({attempt.loop.match, attempt.loop.query, &attempt.loop.row});
  }
  LoopGraph graph = BuildLoopGraph(frames_, edges, scale, options_.loop);
  if (options_.mode == Options::Mode::kPaper) {
    if (!SolvePoseGraph(graph.graph, options_.loop.graph.graph).usable) return;
  } else {
    const RobustPoseGraphSummary summary = SolveRobust(graph.graph, options_.loop.graph, graph.kept_before);
    if (!summary.graph.usable) return;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const bool kept = summary.edge_weight[graph.first_loop + i] > 0;
      LoopClosure& row = loops[i]->loop.row;
      if (kept && row.decision != LoopDecision::kAccepted) row.reason = "other loops agree after all";
      if (!kept) row.reason = "contradicts other loops";
      row.decision = kept ? LoopDecision::kAccepted : LoopDecision::kAmbiguous;
    }
  }
  const std::vector<Pose> before = PosesOf(frames_);
  MoveKeyframes(frames_, graph.keyframes, PosesOf(graph.graph));
  MoveObjects(map_, frames_, before, options_.noise);
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
    for (auto& [local, global] : attempt.pairs) local = HeirOf(local, heirs), global = HeirOf(global, heirs);
  return true;
}

void LoopCloser::Review() {
  passes_.Rebuild();
  if (options_.mode == Options::Mode::kPaper) return;
  const LoopBeliefOptions& o = options_.loop.belief;
  for (Attempt& attempt : attempts_) {
    LoopClosure& row = attempt.loop.row;
    if (row.decision != LoopDecision::kAccepted) continue;
    const Pose T = frames_[attempt.loop.match].T_world_cam.inverse() * frames_[attempt.loop.query].T_world_cam;
    const Pose error = row.T_match_query.inverse() * T;
    if (error.translation().norm() < o.probation_m && error.so3().Log().norm() < o.probation_rad) continue;
    row.decision = LoopDecision::kAmbiguous;
    row.reason = "the refined trajectory disagrees";
  }
}

}  // namespace sslcd
