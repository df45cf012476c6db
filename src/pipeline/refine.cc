// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/refine.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/fuse.h"
#include "pipeline/move.h"
#include "pipeline/stretches.h"
#include "sslcd/core/median.h"

namespace sslcd {
namespace {

bool InMap(const MapLandmark& landmark, const RefineOptions& options) {
  return landmark.state == LandmarkState::kConfirmed &&
         static_cast<int>(landmark.sightings.size()) >= options.min_sightings;
}

// What is seen often enough and has not been found driving belongs to the map, also where the
// stream ended too early for it to be confirmed.
void ConfirmAll(ObjectMap& map, const Options& all) {
  const RefineOptions& options = all.refine;
  std::vector<LandmarkId> confirm, drop;
  for (const auto& [id, landmark] : map.landmarks()) {
    const bool enough = static_cast<int>(landmark.sightings.size()) >= options.min_sightings;
    const bool open =
        landmark.state == LandmarkState::kTentative || landmark.state == LandmarkState::kStale;
    const bool parked = landmark.symmetry == Symmetry::kFull ||
                        landmark.motion.Verdict(all.map.motion) == Motion::kParked;
    if (open && enough && parked) confirm.push_back(landmark.id);
    if (landmark.state == LandmarkState::kConfirmed && !enough) drop.push_back(landmark.id);
  }
  for (const LandmarkId id : confirm) {
    map.SetState(id, LandmarkState::kConfirmed);
    map.SetPose(id, map.at(id).pose);  // back into the index
  }
  for (const LandmarkId id : drop) map.SetState(id, LandmarkState::kStale);
}

// A frame as the optimisation sees it: its nearest keyframe, and where it is from there according
// to the odometry.
struct Anchor {
  int camera = 0;
  Pose T_camera_frame;
};

std::vector<Anchor> Anchors(const std::vector<FrameRecord>& frames,
                            const std::vector<int>& keyframes, double log_scale) {
  std::vector<Anchor> anchors(frames.size());
  const int last = static_cast<int>(keyframes.size()) - 1;
  int camera = 0;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    const auto step_to = [&](int k) {
      Pose T_key_frame = frames[keyframes[k]].T_odom_cam.inverse() * frames[i].T_odom_cam;
      T_key_frame.translation() *= std::exp(log_scale);
      return T_key_frame;
    };
    while (camera < last && keyframes[camera + 1] <= i) ++camera;
    anchors[i] = {camera, step_to(camera)};
    if (camera == last) continue;
    const Pose from_next = step_to(camera + 1);
    if (from_next.translation().norm() < anchors[i].T_camera_frame.translation().norm())
      anchors[i] = {camera + 1, from_next};
  }
  return anchors;
}

// Keyframes are the problem's cameras; what other frames saw counts as seen from the keyframe next
// to them.
BaProblem FullProblem(const ObjectMap& map, const std::vector<FrameRecord>& frames,
                      const std::vector<int>& keyframes, double log_scale,
                      const std::vector<ViewTie>& ties, const Options& options) {
  BaProblem problem;
  problem.gravity = map.gravity();
  problem.noise = options.noise;
  problem.noise_scale = map.noise_scale();
  problem.log_scale = log_scale;
  if (options.level.enabled) problem.slope = {options.level.slope_rad, options.level.window_m};
  for (const int keyframe : keyframes) {
    const FrameRecord& record = frames[keyframe];
    const int camera = static_cast<int>(problem.cameras.size());
    if (camera > 0) {
      const FrameRecord& before = frames[keyframes[camera - 1]];
      problem.odometry.push_back(
          {camera - 1, camera, before.T_odom_cam.inverse() * record.T_odom_cam});
    }
    problem.cameras.push_back({record.frame, record.T_world_cam});
  }
  std::map<int, Anchor> anchor_of_frame;
  const std::vector<Anchor> anchors = Anchors(frames, keyframes, log_scale);
  for (std::size_t i = 0; i < frames.size(); ++i) anchor_of_frame[frames[i].frame] = anchors[i];
  for (const ViewTie& tie : ties) {
    const Anchor &from = anchors[tie.from], &to = anchors[tie.to];
    // from T Exp(d) to^-1 = from T to^-1 Exp(Adj(to) d)
    const Pose::Matrix6 adjoint = to.T_camera_frame.Adj();
    problem.ties.push_back({from.camera,
                            to.camera,
                            {from.T_camera_frame * tie.pose.T_a_b * to.T_camera_frame.inverse(),
                             adjoint * tie.pose.covariance * adjoint.transpose()}});
  }
  for (const auto& [id, landmark] : map.landmarks()) {
    if (!InMap(landmark, options.refine)) continue;
    const int object = static_cast<int>(problem.objects.size());
    problem.objects.push_back({id, landmark.symmetry, landmark.pose});
    for (const Sighting& sighting : landmark.sightings) {
      const Anchor& anchor = anchor_of_frame.at(sighting.frame);
      problem.sightings.push_back(
          {anchor.camera, object, anchor.T_camera_frame * sighting.T_cam_object});
    }
  }
  return problem;
}

// Poses of all sightings in the world.
std::vector<UprightPose> SeenAt(const MapLandmark& landmark, const std::map<int, Pose>& cameras,
                                const GravityFrame& gravity) {
  std::vector<UprightPose> seen;
  for (const Sighting& sighting : landmark.sightings)
    seen.push_back(ToUpright(cameras.at(sighting.frame) * sighting.T_cam_object, gravity));
  return seen;
}

// Objects that are not yet, or never, in the map go along with the cameras that have seen them.
BaSummary Optimise(ObjectMap& map, std::vector<FrameRecord>& frames,
                   const std::vector<int>& keyframes, double& log_scale, const LoopEvidence& loops,
                   const Options& options) {
  BaProblem problem = FullProblem(map, frames, keyframes, log_scale, loops.view_ties, options);
  problem.odometry_factors = loops.odometry_factors;
  BaSummary summary = SolveBa(problem, options.ba);
  if (summary.usable && options.map.learn_noise) {
    problem.noise_scale = EstimateNoiseScale(problem);
    summary = SolveBa(problem, options.ba);
    map.SetNoiseScale(problem.noise_scale);
  }
  if (!summary.usable) return summary;
  std::vector<Pose> poses;
  for (const BaCamera& camera : problem.cameras) poses.push_back(camera.T_world_cam);
  const std::vector<Pose> before = PosesOf(frames);
  MoveKeyframes(frames, keyframes, poses);
  MoveObjects(map, frames, before, options.noise);
  std::map<int, Pose> cameras;
  for (const FrameRecord& record : frames) cameras[record.frame] = record.T_world_cam;
  for (BaObject& object : problem.objects) {
    std::vector<double> yaws;
    for (const UprightPose& seen : SeenAt(map.at({object.id}), cameras, map.gravity()))
      yaws.push_back(seen.yaw);
    if (object.symmetry == Symmetry::kNone) object.pose.yaw = VoteHeading(object.pose.yaw, yaws);
    map.SetPose({object.id}, object.pose);
  }
  log_scale = problem.log_scale;
  return summary;
}

// Every detection that does not belong to a driving object looks for its landmark again, with the
// refined poses.
void AssociateAnew(ObjectMap& map, std::vector<FrameRecord>& frames, const Options& options,
                   const Camera* camera) {
  const Stretches stretches(map, frames, options.map.memory_m);
  std::map<int, std::vector<Sighting>> sightings;
  for (FrameRecord& record : frames) {
    std::vector<Detection> open;
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < record.detections.size(); ++i) {
      const auto owner = map.landmarks().find(record.matched[i].value);
      if (owner != map.landmarks().end() && owner->second.state == LandmarkState::kDynamic)
        continue;
      open.push_back(record.detections[i]);
      index.push_back(i);
    }
    const auto tied = [&](const MapLandmark& landmark) { return stretches.Tied(record, landmark); };
    const std::vector<LandmarkId> matched =
        map.Match(record.stamp, record.T_world_cam, open, camera, tied);
    for (std::size_t k = 0; k < open.size(); ++k) {
      record.matched[index[k]] = matched[k];
      if (matched[k].value < 0) continue;
      const Detection& d = open[k];
      sightings[matched[k].value].push_back(
          {record.frame, record.stamp, d.row, d.score, d.T_cam_object, d.dims});
    }
  }
  std::vector<LandmarkId> confirmed;
  for (const auto& [id, landmark] : map.landmarks())
    if (landmark.state == LandmarkState::kConfirmed) confirmed.push_back({id});
  for (const LandmarkId id : confirmed) map.SetSightings(id, std::move(sightings[id.value]));
}

// Compares where a landmark was seen early with where it was seen late.
bool HasMoved(const std::vector<UprightPose>& seen, const GravityFrame& gravity, double moved_m,
              double elapsed_s, double min_speed_mps) {
  const int third = static_cast<int>(seen.size()) / 3;
  if (third < 2) return false;
  const auto median = [&](int from, const Vec3& axis) {
    std::vector<double> values;
    for (int i = from; i < from + third; ++i) values.push_back(seen[i].position.dot(axis));
    return Median(std::move(values));
  };
  const int late = static_cast<int>(seen.size()) - third;
  const double distance = std::hypot(median(late, gravity.forward) - median(0, gravity.forward),
                                     median(late, gravity.left) - median(0, gravity.left));
  return distance > moved_m && distance > min_speed_mps * elapsed_s;
}

// Share of the frames between its sightings in which a landmark was seen. Not counted: frames
// without any detection, in which the detector may not have run, and gaps of more than two seconds,
// in which it was out of sight. `detector_runs`: frame -> how many frames with detections there
// were up to it.
double SeenShare(const MapLandmark& landmark, const std::map<int, int>& detector_runs) {
  int runs = 1;
  for (std::size_t i = 1; i < landmark.sightings.size(); ++i) {
    const Sighting &before = landmark.sightings[i - 1], &now = landmark.sightings[i];
    runs += now.stamp - before.stamp > 2.
                ? 1
                : detector_runs.at(now.frame) - detector_runs.at(before.frame);
  }
  return static_cast<double>(landmark.sightings.size()) / runs;
}

void RejectMoved(ObjectMap& map, const std::vector<FrameRecord>& frames, const Options& options) {
  std::map<int, Pose> cameras;
  std::map<int, int> detector_runs;
  int runs = 0;
  for (const FrameRecord& record : frames) {
    cameras[record.frame] = record.T_world_cam;
    detector_runs[record.frame] = runs += record.detections.empty() ? 0 : 1;
  }
  std::vector<LandmarkId> moved;
  for (const auto& [id, landmark] : map.landmarks()) {
    if (landmark.state != LandmarkState::kConfirmed || landmark.symmetry == Symmetry::kFull)
      continue;
    const double elapsed = landmark.sightings.back().stamp - landmark.sightings.front().stamp;
    if (HasMoved(SeenAt(landmark, cameras, map.gravity()), map.gravity(), options.refine.moved_m,
                 elapsed, options.map.motion.min_speed_mps) ||
        SeenShare(landmark, detector_runs) < options.refine.min_seen_share)
      moved.push_back({id});
  }
  for (const LandmarkId id : moved) map.SetState(id, LandmarkState::kDynamic);
}

}  // namespace

BaSummary OptimiseAfterLoop(ObjectMap& map, std::vector<FrameRecord>& frames, double scale,
                            const Options& options) {
  constexpr double kTurn = 0.5;  // [rad] that makes a keyframe, as in the pose graph
  // from where the pose graph has left everything; more of them change next to nothing
  constexpr int kMaxSteps = 4;
  const std::vector<int> keyframes = SelectKeyframes(frames, options.loop.keyframe_m, kTurn);
  if (static_cast<int>(keyframes.size()) > options.loop.adjust_keyframes) return {};
  Options after_loop = options;
  after_loop.map.learn_noise = false;
  after_loop.ba.max_iterations = std::min(options.ba.max_iterations, kMaxSteps);
  after_loop.ba.odometry = options.loop.odometry;
  after_loop.ba.odometry.scale_prior = 0;  // the scale stays
  double log_scale = std::log(scale);
  return Optimise(map, frames, keyframes, log_scale, {}, after_loop);
}

BaSummary RefineMap(ObjectMap& map, std::vector<FrameRecord>& frames, double& log_scale,
                    const LoopEvidence& loops, const Options& options, const Camera* camera) {
  ConfirmAll(map, options);
  const std::vector<int> keyframes =
      SelectKeyframes(frames, options.refine.keyframe_m, options.refine.keyframe_rad);
  BaSummary summary = Optimise(map, frames, keyframes, log_scale, loops, options);
  for (int round = 0; round < options.refine.rounds; ++round) {
    RejectMoved(map, frames, options);
    FuseDuplicates(map, frames, options);
    AssociateAnew(map, frames, options, camera);
    ConfirmAll(map, options);
    summary = Optimise(map, frames, keyframes, log_scale, loops, options);
  }
  return summary;
}

}  // namespace sslcd
