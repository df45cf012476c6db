// SPDX-License-Identifier: BSD-3-Clause
#include "refine/trajectory_correction.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace sslcd {
namespace {

// Path length up to each frame in odometry metres. A camera at rest adds a tiny length, so that
// weights by path are always defined.
std::vector<double> PathOf(const FrameStore& frames) {
  constexpr double kCreep = 1e-6;  // a frame [m]
  std::vector<double> path(frames.size(), 0.);
  for (int i = 1; i < frames.size(); ++i) {
    const Vec3 step = frames[i].T_odom_cam.translation() - frames[i - 1].T_odom_cam.translation();
    path[i] = path[i - 1] + step.norm() + kCreep;
  }
  return path;
}

}  // namespace

std::vector<int> SelectKeyframes(const FrameStore& frames, double distance_m, double turn_rad) {
  std::vector<int> keyframes;
  const std::vector<double> path = PathOf(frames);
  const int count = frames.size();
  for (int i = 0; i < count; ++i) {
    const bool border = i == 0 || i + 1 == count || IsLost(frames, i) != IsLost(frames, i + 1);
    if (border || path[i] - path[keyframes.back()] >= distance_m ||
        (frames[keyframes.back()].T_odom_cam.so3().inverse() * frames[i].T_odom_cam.so3())
                .Log()
                .norm() >= turn_rad)
      keyframes.push_back(i);
  }
  return keyframes;
}

void MoveKeyframes(FrameStore& frames, const std::vector<int>& keyframes,
                   const std::vector<Pose>& poses) {
  assert(keyframes.size() == poses.size());
  if (keyframes.empty()) return;
  const std::vector<double> path = PathOf(frames);
  const std::vector<Pose> before = PosesOf(frames);
  const int last = static_cast<int>(keyframes.size()) - 1;
  int k = 0;  // the keyframe at or before frame i
  for (int i = 0; i < frames.size(); ++i) {
    while (k < last && keyframes[k + 1] <= i) ++k;
    const int from = keyframes[k];
    Pose T_key_frame = before[from].inverse() * before[i];
    if (i > from && k < last) {
      // The correction of the step to the next keyframe in the frame of this one, so that the
      // rotation has no lever arm.
      const int to = keyframes[k + 1];
      const Pose correction =
          poses[k].inverse() * poses[k + 1] * (before[from].inverse() * before[to]).inverse();
      const double share = (path[i] - path[from]) / (path[to] - path[from]);
      T_key_frame = Pose::Exp(share * correction.Log()) * T_key_frame;
    }
    Pose T_world_cam = poses[k] * T_key_frame;
    T_world_cam.normalise();
    frames.SetPose(i, T_world_cam);
  }
}

void MoveObjects(MapState& state, const std::vector<Pose>& before, const DetectionNoise& noise) {
  ObjectMap& map = state.map;
  const FrameStore& frames = state.frames;
  assert(static_cast<std::size_t>(frames.size()) == before.size());
  std::map<int, Pose> moved;  // by frame number: the motion of its camera in the world
  for (int i = 0; i < frames.size(); ++i)
    moved[frames[i].frame] = frames[i].T_world_cam * before[i].inverse();

  std::vector<std::pair<LandmarkId, UprightPose>> carried;
  for (const auto& [id, landmark] : map.landmarks()) {
    const Pose T_world_object = ToPose(landmark.pose, map.gravity());
    Vec3 position(0, 0, 0);
    Vec2 turn(0, 0);  // a sum of unit vectors, since angles have no mean
    double information = 0;
    for (const Sighting& sighting : landmark.sightings) {
      const auto motion = moved.find(sighting.frame);
      if (motion == moved.end()) continue;
      const double sigma = SigmasAt(sighting.T_cam_object.translation().norm(), noise, {}).radial;
      const UprightPose seen = ToUpright(motion->second * T_world_object, map.gravity());
      const double weight = 1 / (sigma * sigma);
      position += weight * seen.position;
      turn += weight *
              Vec2(std::cos(seen.yaw - landmark.pose.yaw), std::sin(seen.yaw - landmark.pose.yaw));
      information += weight;
    }
    if (information > 0)
      carried.push_back({landmark.id,
                         {position / information,
                          WrapAngle(landmark.pose.yaw + std::atan2(turn.y(), turn.x()))}});
  }
  for (const auto& [id, pose] : carried) map.SetPose(id, pose);
}

}  // namespace sslcd
