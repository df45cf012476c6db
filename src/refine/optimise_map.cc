// SPDX-License-Identifier: BSD-3-Clause
#include "refine/optimise_map.h"

#include <cmath>

#include "refine/trajectory_correction.h"

namespace sslcd {
namespace {

bool InMap(const MapLandmark& landmark, const RefineOptions& options) {
  return landmark.state == LandmarkState::kConfirmed &&
         static_cast<int>(landmark.sightings.size()) >= options.min_sightings;
}

// The nearest keyframe of a frame and the odometry between them.
struct Anchor {
  int camera = 0;
  Pose T_camera_frame;
};

std::vector<Anchor> Anchors(const FrameStore& frames, const std::vector<int>& keyframes,
                            double log_scale) {
  std::vector<Anchor> anchors(frames.size());
  const int last = static_cast<int>(keyframes.size()) - 1;
  int camera = 0;
  for (int i = 0; i < frames.size(); ++i) {
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

}  // namespace

BaProblem MapProblem(const MapState& state, const std::vector<int>& keyframes, double log_scale,
                     const LoopEvidence& loops, const WholeMapOptions& options) {
  const ObjectMap& map = state.map;
  const FrameStore& frames = state.frames;
  BaProblem problem;
  problem.gravity = map.gravity();
  problem.noise = options.noise;
  problem.noise_scale = map.noise_scale();
  problem.odometry_factors = loops.odometry_factors;
  problem.log_scale = log_scale;
  if (options.level.enabled) problem.slope = {options.level.slope_rad, options.level.window_m};
  for (const int keyframe : keyframes) {
    const FrameRecord& record = frames[keyframe];
    const int camera = static_cast<int>(problem.cameras.size());
    if (camera > 0) {
      const FrameRecord& before = frames[keyframes[camera - 1]];
      const OdometryFailures failures = FailuresBetween(frames, keyframes[camera - 1], keyframe);
      Pose step = before.T_odom_cam.inverse() * record.T_odom_cam;
      if (failures.lost > 0) {  // as OdometryBetween()
        step = before.T_world_cam.inverse() * record.T_world_cam;
        step.translation() *= std::exp(-log_scale);
      }
      problem.odometry.push_back({camera - 1, camera, step, failures});
    }
    problem.cameras.push_back({record.frame, record.T_world_cam});
  }
  std::map<int, Anchor> anchor_of_frame;
  const std::vector<Anchor> anchors = Anchors(frames, keyframes, log_scale);
  for (int i = 0; i < frames.size(); ++i) anchor_of_frame[frames[i].frame] = anchors[i];
  for (const ViewTie& tie : loops.view_ties) {
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

std::vector<UprightPose> SeenAt(const MapLandmark& landmark, const std::map<int, Pose>& cameras,
                                const GravityFrame& gravity) {
  std::vector<UprightPose> seen;
  for (const Sighting& sighting : landmark.sightings)
    seen.push_back(ToUpright(cameras.at(sighting.frame) * sighting.T_cam_object, gravity));
  return seen;
}

BaSummary OptimiseMap(MapState& state, const std::vector<int>& keyframes, double& log_scale,
                      const LoopEvidence& loops, const WholeMapOptions& options) {
  ObjectMap& map = state.map;
  FrameStore& frames = state.frames;
  BaProblem problem = MapProblem(state, keyframes, log_scale, loops, options);
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
  MoveObjects(state, before, options.noise);
  std::map<int, Pose> cameras;
  for (const FrameRecord& record : frames) cameras[record.frame] = record.T_world_cam;
  for (BaObject& object : problem.objects) {
    std::vector<Vec2> headings;
    for (const UprightPose& seen : SeenAt(map.at({object.id}), cameras, map.gravity()))
      headings.emplace_back(std::cos(seen.yaw), std::sin(seen.yaw));
    if (object.symmetry == Symmetry::kNone)
      object.pose.yaw = VoteHeading(object.pose.yaw, headings);
    map.SetPose({object.id}, object.pose);
  }
  log_scale = problem.log_scale;
  return summary;
}

}  // namespace sslcd
