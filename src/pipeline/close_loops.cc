// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/close_loops.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>

#include "pipeline/move.h"
#include "sslcd/optim/drift.h"
#include "sslcd/optim/pose_graph_robust.h"

namespace sslcd {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

// Which way a camera looks, horizontally.
double Heading(const Pose& T_world_cam, const GravityFrame& gravity) {
  const Vec3 axis = T_world_cam.so3() * Vec3::UnitZ();
  return std::atan2(axis.dot(gravity.left), axis.dot(gravity.forward));
}

// Turns the world about a camera so that the cameras within some metres of path stand upright on average.
Pose Levelling(const std::vector<FrameRecord>& frames, int at, const GravityFrame& gravity) {
  constexpr double kReach = 20.;  // [m]
  const Vec3 up_in_cam = frames.front().T_world_cam.so3().inverse() * gravity.up;
  Vec3 up = Vec3::Zero();
  for (int step : {-1, 1})
    for (int f = at; f >= 0 && f < static_cast<int>(frames.size()); f += step) {
      if (std::abs(frames[f].travelled - frames[at].travelled) > kReach) break;
      up += frames[f].T_world_cam.so3() * up_in_cam;
    }
  const Vec3 axis = up.normalized().cross(gravity.up);
  const double tilt = std::atan2(axis.norm(), up.normalized().dot(gravity.up));
  const auto turn = lie::SO3<double>::Exp(axis.norm() > 1e-12 ? Vec3(tilt * axis.normalized()) : Vec3(Vec3::Zero()));
  const Vec3 pivot = frames[at].T_world_cam.translation();
  return {turn, pivot - turn * pivot};
}

int FrameAt(const std::vector<FrameRecord>& frames, double path_m) {
  const auto at = std::lower_bound(frames.begin(), frames.end(), path_m,
                                   [](const FrameRecord& frame, double m) { return frame.travelled < m; });
  return static_cast<int>(std::min(at, frames.end() - 1) - frames.begin());
}

}  // namespace

LoopCloser::LoopCloser(const Options& options, ObjectMap& map, std::vector<FrameRecord>& frames)
    : options_(options),
      map_(map),
      frames_(frames),
      passes_(map, frames, options.noise, options.loop.split_m),
      tracks_(options.loop.tracks) {}

std::vector<LoopClosure> LoopCloser::closures() const {
  std::vector<LoopClosure> rows;
  for (const Attempt& attempt : attempts_) rows.push_back(attempt.row);
  return rows;
}

bool LoopCloser::Closed() const {
  return std::any_of(attempts_.begin(), attempts_.end(), [](const Attempt& attempt) { return attempt.believed; });
}

bool LoopCloser::AddKeyframe(double scale, TimingTable& timing) {
  const double here = frames_.back().travelled;
  if (here - last_attempt_m_ < options_.loop.every_m) return false;
  last_attempt_m_ = here;
  {
    const ScopedTimer timer(timing, "loop detection");
    if (!Detect(options_.loop.lag_m)) return false;
  }
  const ScopedTimer timer(timing, "drift correction");
  const bool moved = !Agree();
  if (moved) Correct(scale);
  const bool fused = Fuse();
  return moved || fused;
}

// True if the trajectory as it stands goes through all loops found since the last correction.
bool LoopCloser::Agree() const {
  const double limit = Chi2Quantile(0.9, 6);
  return std::all_of(attempts_.begin(), attempts_.end(), [&](const Attempt& attempt) {
    if (!attempt.believed || attempt.in_graph) return true;
    const Pose T = frames_[attempt.match].T_world_cam.inverse() * frames_[attempt.query].T_world_cam;
    const Vec6 error = (attempt.row.T_match_query.inverse() * T).Log();
    return error.dot(Mat6(attempt.row.covariance).ldlt().solve(error)) < limit;
  });
}

// Log odds of a pose before any object is looked at: how far would odometry have to be off?
PoseTracks::Prior LoopCloser::PriorOf(const PassLayout& local, const PassLayout& global,
                                      const LayoutIndex& index) const {
  std::map<int, double> seen_at;
  for (const PassObject& pass : passes_.passes()) seen_at.insert({pass.id.value, pass.last_m});
  const PathGraph::Distances distances = path_.From(frames_.back().travelled);
  const double volume = 2 * M_PI * static_cast<double>(index.objects().size()) / index.density();
  return [=, &local, &global, &o = options_.loop](const YawShift& pose, const LayoutFit& fit) {
    if (fit.matches.empty()) return 0.;
    std::vector<double> paths;
    Vec3 centre = Vec3::Zero();
    for (const auto& [i, j] : fit.matches) {
      paths.push_back(distances.To(seen_at.at(global.objects[j].id)));
      centre += local.objects[i].position / static_cast<double>(fit.matches.size());
    }
    std::nth_element(paths.begin(), paths.begin() + paths.size() / 2, paths.end());
    const double path = paths[paths.size() / 2];
    const double sigma_yaw = std::hypot(0.02, o.drift_yaw * std::sqrt(path));
    const double sigma = std::hypot(1., o.drift_share * path, sigma_yaw * path / std::sqrt(3.));
    const double moved = (Apply(pose, centre) - centre).head<2>().norm();
    const double gauss = std::exp(-0.5 * (std::pow(moved / sigma, 2) + std::pow(WrapAngle(pose.yaw) / sigma_yaw, 2))) /
                         (std::pow(2 * M_PI, 1.5) * sigma * sigma * std::min(sigma_yaw, 2.5));
    return std::log(o.surprise + (1 - o.surprise) * volume * gauss);
  };
}

// Where the query camera stands in the match camera's frame, if `track` is right. Both cameras are taken from the midst
// of what was matched, where the layouts agree best; objects seen far from there count less, by as much as odometry may
// have bent the path in between.
bool LoopCloser::Measure(double lag_m, const PoseTrack& track, const PassLayout& local, const PassLayout& global,
                         Attempt& attempt) const {
  // As recent as possible, but where the heading is known.
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3 && best >= options_.loop.max_heading_sigma_rad; ++i) {
    Attempt now;
    if (!MeasureAt(lag_m + 10. * i, track, local, global, now)) continue;
    if (now.heading_sigma < best) best = now.heading_sigma, attempt = std::move(now);
  }
  return std::isfinite(best);
}

void LoopCloser::Finish(double scale, TimingTable& timing) {
  if (frames_.empty()) return;
  const ScopedTimer timer(timing, "loop detection at the end");
  bool any = false;
  for (const double lag : {options_.loop.lag_m - 10., options_.loop.lag_m - 20.}) any |= lag > 0 && Detect(lag);
  if (any && !Agree()) Correct(scale);
  if (any) Fuse();
}

void LoopCloser::Review() {
  for (Attempt& attempt : attempts_) {
    if (attempt.row.decision != LoopDecision::kAccepted) continue;
    const Pose T = frames_[attempt.match].T_world_cam.inverse() * frames_[attempt.query].T_world_cam;
    const Pose error = attempt.row.T_match_query.inverse() * T;
    if (error.translation().norm() < options_.loop.probation_m &&
        error.so3().Log().norm() < options_.loop.probation_rad)
      continue;
    attempt.row.decision = LoopDecision::kAmbiguous;
    attempt.row.reason = "the refined trajectory disagrees";
  }
}

bool LoopCloser::MeasureAt(double lag_m, const PoseTrack& track, const PassLayout& local, const PassLayout& global,
                           Attempt& attempt) const {
  const LoopOptions& o = options_.loop;
  LoopClosure& row = attempt.row;
  std::vector<DriftPair> pairs;
  std::vector<double> seen;  // where on the path
  for (const auto& [i, j] : track.fit.matches) {
    DriftPair pair;
    pair.T_world_local = ToPose(local.places[i], map_.gravity());
    pair.T_world_global = ToPose(global.places[j], map_.gravity());
    pair.symmetry = local.objects[i].symmetry;
    pair.sigma_horizontal_m = pair.sigma_vertical_m = track.fit.sigma;
    pair.sigma_yaw_rad = 0.2;
    pairs.push_back(pair);
    row.pairs.push_back({{local.objects[i].id}, {global.objects[j].id}});
    seen.push_back(local.seen_m[i]);
  }
  attempt.fuse = row.pairs;
  DriftResult drift = SolveDrift(pairs, map_.gravity(), o.drift);
  if (!drift.usable) return false;
  // As recent as the matches allow: not beyond the last but a fifth of them.
  std::sort(seen.begin(), seen.end());
  const double query_m = std::clamp(frames_.back().travelled - lag_m, seen[seen.size() / 5], seen[seen.size() * 4 / 5]);
  attempt.query = FrameAt(frames_, query_m);
  attempt.match = NearestOldFrame(drift.T_global_local * frames_[attempt.query].T_world_cam, row.pairs);
  if (attempt.match < 0) return false;
  const double match_m = frames_[attempt.match].travelled;
  // The ground at one place has one slope: what is upright for the cameras there is upright for both maps.
  const Pose L_query = Levelling(frames_, attempt.query, map_.gravity());
  const Pose L_match = Levelling(frames_, attempt.match, map_.gravity());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [i, j] = track.fit.matches[k];
    const double bent = std::hypot(Bent(attempt.query, local.seen_m[i]),
                                   Bent(attempt.match, passes_.NearestPass(row.pairs[k].second, match_m)));
    pairs[k].sigma_horizontal_m = pairs[k].sigma_vertical_m = std::hypot(track.fit.sigma, bent);
    pairs[k].T_world_local = L_query * pairs[k].T_world_local;
    pairs[k].T_world_global = L_match * pairs[k].T_world_global;
  }
  drift = SolveDrift(pairs, map_.gravity(), o.drift);
  if (!drift.usable) return false;

  const Pose corrected = L_match.inverse() * drift.T_global_local * L_query * frames_[attempt.query].T_world_cam;
  const Pose& T_world_match = frames_[attempt.match].T_world_cam;
  row.query_frame = frames_[attempt.query].frame;
  row.match_frame = frames_[attempt.match].frame;
  row.T_match_query = T_world_match.inverse() * corrected;
  row.viewpoint_change_rad = std::abs(WrapAngle(Heading(corrected, map_.gravity()) - Heading(T_world_match, map_.gravity())));
  const Mat6 to_query = (L_query * frames_[attempt.query].T_world_cam).inverse().Adj();
  row.covariance = to_query * Mat6(drift.covariance) * to_query.transpose();
  row.covariance.diagonal().head<3>().array() += o.sigma_m * o.sigma_m;
  row.covariance.diagonal().tail<3>().array() += o.sigma_rad * o.sigma_rad;
  const Vec3 up_in_query = (L_query * frames_[attempt.query].T_world_cam).so3().inverse() * map_.gravity().up;
  attempt.heading_sigma = std::sqrt(up_in_query.dot(Mat6(row.covariance).bottomRightCorner<3, 3>() * up_in_query));
  return true;
}

// How far odometry may have moved what was seen at `seen_m` of the path, relative to a frame. [m]
double LoopCloser::Bent(int frame, double seen_m) const {
  constexpr double kRange = 10.;  // from where an object is seen [m]
  const Pose step = frames_[frame].T_odom_cam.inverse() * frames_[FrameAt(frames_, seen_m)].T_odom_cam;
  const OdometrySigmas sigmas = SigmasOf(step, options_.loop.odometry);
  return std::hypot(sigmas.translation, sigmas.rotation * (0.5 * step.translation().norm() + kRange));
}

// The frame nearest to a pose among those of the passes on which the matched old objects were seen; -1: none.
int LoopCloser::NearestOldFrame(const Pose& T_world_cam,
                                const std::vector<std::pair<LandmarkId, LandmarkId>>& matches) const {
  std::set<LandmarkId> ids;
  for (const auto& match : matches) ids.insert(match.second);
  int best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (const PassObject& pass : passes_.passes()) {
    if (ids.count(pass.id) == 0 || pass.last_m >= OldUntil()) continue;
    for (int f = pass.sightings.front().first; f <= pass.sightings.back().first; ++f) {
      const double distance = (frames_[f].T_world_cam.translation() - T_world_cam.translation()).norm();
      if (distance < nearest) nearest = distance, best = f;
    }
  }
  return best;
}

// True: something new is believed.
bool LoopCloser::Detect(double lag_m) {
  const double here = frames_.back().travelled;
  const LoopOptions& o = options_.loop;
  passes_.Update();
  const PassLayout local = passes_.Recent(here - o.local_m, o.min_sightings);
  const PassLayout global = passes_.Before(OldUntil(), o.min_sightings);
  if (local.objects.size() < 4 || global.objects.size() < 4) return false;
  const LayoutIndex index(global.objects, o.match.max_pair_m, o.match.reach_m);
  std::vector<PoseHypothesis> found = MatchLayouts(local.objects, index, o.match).hypotheses;
  PoseHypothesis none;  // odometry may be right
  none.fit = LayoutLikelihood(local.objects, index, o.match.likelihood).Refine(none.pose, 4);
  if (static_cast<int>(none.fit.matches.size()) >= o.match.search.min_matches) found.insert(found.begin(), none);
  tracks_.Update(local.objects, index, found, o.match, here, PriorOf(local, global, index));

  Attempt attempt;
  if (tracks_.tracks().empty()) return false;
  const PoseTrack& best = tracks_.tracks()[0];
  if (!Measure(lag_m, best, local, global, attempt)) return false;
  attempt.track = best.id;
  LoopClosure& row = attempt.row;
  row.score = tracks_.Margin(0);
  row.second_score = tracks_.tracks().size() > 1 ? tracks_.Margin(1) : -row.score;
  row.decision = LoopDecision::kAmbiguous;
  if (best.evidence < 0)
    row.decision = LoopDecision::kNone, row.reason = "chance explains the best pose";
  else
    row.reason = "another pose fits nearly as well";
  // How much better than chance its own objects agree at the place where the track expects them. [nats]
  attempt.own_evidence = best.fit.evidence + std::log(2 * M_PI * static_cast<double>(index.objects().size()) /
                                                      (index.density() * o.place_m2_rad));
  const double apart = row.T_match_query.translation().norm();
  const bool confirmed = attempt.own_evidence >= o.min_own_evidence && attempt.heading_sigma < o.max_heading_sigma_rad &&
                         apart < o.max_apart_m;
  const bool believed = row.score >= o.min_margin && confirmed;
  attempt.believed = believed;
  attempt.confirmed = confirmed;
  if (row.score >= o.min_margin && !confirmed)
    row.reason = attempt.own_evidence < o.min_own_evidence         ? "too few objects of its own agree"
                 : attempt.heading_sigma >= o.max_heading_sigma_rad ? "heading too uncertain"
                                                            : "no old camera stood near";
  if (believed) {
    row.decision = LoopDecision::kAccepted;
    row.reason = std::to_string(best.fit.matches.size()) + " objects agree";
    for (Attempt& earlier : attempts_) {
      if (earlier.track != best.id || earlier.believed || !earlier.confirmed) continue;
      earlier.believed = true;
      earlier.row.decision = LoopDecision::kAccepted;
      earlier.row.reason = "settled by frame " + std::to_string(row.query_frame);
      path_.AddShortcut(frames_[earlier.query].travelled, frames_[earlier.match].travelled);
    }
    path_.AddShortcut(frames_[attempt.query].travelled, frames_[attempt.match].travelled);
  }
  static FILE* dump = getenv("SSLCD_DUMP") ? fopen(getenv("SSLCD_DUMP"), "w") : nullptr;
  if (dump) {
    int rank = 0;
    for (std::size_t k = 0; k < tracks_.tracks().size() && k < 8; ++k) {
      const PoseTrack& t = tracks_.tracks()[k];
      Attempt a;
      Measure(lag_m, t, local, global, a);
      fprintf(dump, "%d %d %d %.3f %.3f %.3f %zu %zu %zu %d %d", a.row.query_frame, ++rank, a.row.match_frame,
              t.evidence, tracks_.Margin(k), t.prior, t.fit.matches.size(), local.objects.size(), global.objects.size(),
              t.fit.should_see, frames_.back().frame);
      const Pose T = a.row.T_match_query;
      for (int i = 0; i < 3; ++i) fprintf(dump, " %.4f", T.translation()[i]);
      const auto q = T.so3().unit_quaternion();
      fprintf(dump, " %.6f %.6f %.6f %.6f %.3f %zu %.3f %.4f %.4f\n", q.x(), q.y(), q.z(), q.w(), t.fit.evidence, t.votes.size(),
              t.fit.evidence + std::log(2 * M_PI * index.objects().size() / index.density() / 2.5),
              std::sqrt(a.row.covariance(4, 4)), std::sqrt(a.row.covariance(0, 0) + a.row.covariance(2, 2)));
    }
  }
  attempts_.push_back(std::move(attempt));
  return believed;
}

void LoopCloser::Correct(double scale) {
  // Vertices: keyframes and the ends of all loops.
  std::set<int> chosen;
  for (const int k : SelectKeyframes(frames_, options_.loop.keyframe_m, 0.5)) chosen.insert(k);
  for (const Attempt& attempt : attempts_)
    if (attempt.believed) chosen.insert({attempt.query, attempt.match});
  const std::vector<int> keyframes(chosen.begin(), chosen.end());
  PoseGraph graph;
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    graph.vertices.push_back({keyframes[k], frames_[keyframes[k]].T_world_cam, k == 0});
    if (k == 0) continue;
    PoseGraph::Edge& edge = graph.edges.emplace_back();
    edge.from = keyframes[k - 1];
    edge.to = keyframes[k];
    edge.T_from_to = frames_[edge.from].T_odom_cam.inverse() * frames_[edge.to].T_odom_cam;
    const OdometrySigmas sigmas = SigmasOf(edge.T_from_to, options_.loop.odometry);
    edge.T_from_to.translation() *= scale;
    edge.information.setZero();
    edge.information.diagonal().head<3>().setConstant(1 / (sigmas.translation * sigmas.translation));
    edge.information.diagonal().tail<3>().setConstant(1 / (sigmas.rotation * sigmas.rotation));
  }
  std::vector<Attempt*> loops;
  for (Attempt& attempt : attempts_) {
    if (!attempt.believed) continue;
    PoseGraph::Edge& edge = graph.edges.emplace_back();
    edge.from = attempt.match;
    edge.to = attempt.query;
    edge.T_from_to = attempt.row.T_match_query;
    edge.information = Mat6(attempt.row.covariance).inverse();
    edge.loop = true;
    attempt.in_graph = true;
    loops.push_back(&attempt);
  }
  std::vector<double> kept_before(graph.edges.size(), 1.);
  for (std::size_t e = 0; e < loops.size(); ++e)
    kept_before[graph.edges.size() - loops.size() + e] = loops[e]->row.decision == LoopDecision::kAccepted ? 1 : 0;
  const RobustPoseGraphSummary summary = SolveRobust(graph, options_.loop.graph, kept_before);
  if (getenv("VERB"))
    fprintf(stderr, "frame %d: %zu loops, kept %d refused %d chi2 %.1f -> %.1f usable %d %s\n", frames_.back().frame,
            loops.size(), summary.loops_kept, summary.loops_refused, summary.graph.initial_chi2,
            summary.graph.final_chi2, summary.graph.usable, summary.graph.message.c_str());
  if (!summary.graph.usable) return;
  const std::size_t first_loop = graph.edges.size() - loops.size();
  for (std::size_t e = 0; e < loops.size(); ++e) {
    const bool kept = summary.edge_weight[first_loop + e] > 0;
    loops[e]->row.decision = kept ? LoopDecision::kAccepted : LoopDecision::kAmbiguous;
    if (!kept) loops[e]->row.reason = "contradicts other loops";
  }
  const std::vector<Pose> before = PosesOf(frames_);
  std::vector<Pose> poses;
  for (const auto& vertex : graph.vertices) poses.push_back(vertex.T_world_vertex);
  MoveKeyframes(frames_, keyframes, poses);
  MoveObjects(map_, frames_, before, options_.noise);
  const UprightPose change = ToUpright(frames_.back().T_world_cam * before.back().inverse(), map_.gravity());
  const Pose moved = frames_.back().T_world_cam * before.back().inverse();
  // Yaw part about the last camera.
  const double yaw = std::atan2((moved.so3() * map_.gravity().forward).dot(map_.gravity().left),
                                (moved.so3() * map_.gravity().forward).dot(map_.gravity().forward));
  (void)change;
  YawShift shift;
  shift.yaw = yaw;
  const Eigen::Matrix3d to_layout = map_.gravity().Basis().transpose();
  const Vec3 was = to_layout * before.back().translation(), is = to_layout * frames_.back().T_world_cam.translation();
  shift.t = is - Apply(shift, was);
  shift.t.z() = 0;  // layouts have heights of their own
  tracks_.Move(shift);
}

// What was matched becomes one landmark.
bool LoopCloser::Fuse() {
  std::map<int, LandmarkId> heirs;
  const auto name = [&](LandmarkId id) {
    for (auto heir = heirs.find(id.value); heir != heirs.end(); heir = heirs.find(id.value)) id = heir->second;
    return id;
  };
  for (Attempt& attempt : attempts_) {
    if (attempt.row.decision != LoopDecision::kAccepted) continue;
    for (const auto& [local, global] : attempt.fuse) {
      const LandmarkId drop = name(local), keep = name(global);
      const auto& all = map_.landmarks();
      if (keep == drop || all.count(keep.value) == 0 || all.count(drop.value) == 0) continue;
      const MapLandmark &a = all.at(keep.value), &b = all.at(drop.value);
      if (a.label != b.label || (a.pose.position - b.pose.position).norm() > options_.loop.fuse_m) continue;
      map_.Fuse(keep, drop);
      heirs[drop.value] = keep;
    }
  }
  if (heirs.empty()) return false;
  for (FrameRecord& record : frames_)
    for (LandmarkId& id : record.matched) id = name(id);
  passes_.Rename(heirs);
  for (Attempt& attempt : attempts_)
    for (auto& [local, global] : attempt.fuse) local = name(local), global = name(global);
  return true;
}

}  // namespace sslcd
