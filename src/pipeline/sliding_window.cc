// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/sliding_window.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sslcd {

Pose PredictPose(const FrameRecord& from, const Pose& T_odom_cam, double log_scale) {
  const Pose step = from.T_odom_cam.inverse() * T_odom_cam;
  return from.T_world_cam * Pose(step.so3(), step.translation() * std::exp(log_scale));
}

bool SlidingWindow::IsKeyframe(const FrameStore& frames, const Pose& T_odom_cam) const {
  if (keyframes_.empty()) return true;
  const Pose step = frames[keyframes_.back()].T_odom_cam.inverse() * T_odom_cam;
  return step.translation().norm() >= options_.keyframe_m ||
         step.so3().Log().norm() >= options_.keyframe_rad;
}

BaSummary SlidingWindow::AddKeyframe(MapState& state, double& log_scale,
                                     double expected_log_scale) {
  FrameStore& frames = state.frames;
  const bool moved = frames.FirstChangeSince(revision_) < known_frames_;
  if (moved || state.map.rewrites() != map_rewrites_) {
    prior_ = {};
    if (!keyframes_.empty()) keyframes_.erase(keyframes_.begin(), keyframes_.end() - 1);
  }
  const int newest = frames.size() - 1;
  if (!keyframes_.empty() && FailuresBetween(frames, keyframes_.back(), newest).lost > 0) {
    prior_ = {};  // nothing joins the window to the new keyframe, which would be free to move
    keyframes_.clear();
  }
  keyframes_.push_back(newest);
  BaSummary summary;
  if (options_.enabled) {
    BaProblem problem = Problem(state, log_scale, expected_log_scale);
    problem.hold_first = true;
    summary = SolveBa(problem, ba_);
    problem.hold_first = false;
    if (summary.usable) {
      for (std::size_t i = 0; i < keyframes_.size(); ++i)
        frames.SetPose(keyframes_[i], problem.cameras[i].T_world_cam);
      for (const BaObject& object : problem.objects)
        if (state.map.at({object.id}).state == LandmarkState::kConfirmed)
          state.map.SetPose({object.id}, object.pose);
      log_scale = problem.log_scale;
    }
    if (static_cast<int>(keyframes_.size()) >= options_.keyframes) Slide(state, problem);
  }
  revision_ = frames.revision();
  known_frames_ = frames.size();
  map_rewrites_ = state.map.rewrites();
  return summary;
}

BaProblem SlidingWindow::Problem(const MapState& state, double log_scale,
                                 double expected_log_scale) const {
  BaProblem problem;
  problem.gravity = state.gravity();
  problem.noise = noise_;
  problem.noise_scale = state.map.noise_scale();
  problem.log_scale = log_scale;
  problem.expected_log_scale = expected_log_scale;
  problem.prior = prior_;
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    const FrameRecord& record = state.frames[keyframes_[i]];
    problem.cameras.push_back({record.frame, record.T_world_cam});
    if (i == 0) continue;
    const FrameRecord& before = state.frames[keyframes_[i - 1]];
    problem.odometry.push_back({static_cast<int>(i) - 1, static_cast<int>(i),
                                before.T_odom_cam.inverse() * record.T_odom_cam,
                                FailuresBetween(state.frames, keyframes_[i - 1], keyframes_[i])});
  }
  AddObjects(state, problem);
  return problem;
}

void SlidingWindow::AddObjects(const MapState& state, BaProblem& problem) const {
  std::set<int> ids(prior_.object_ids.begin(), prior_.object_ids.end());
  for (const int keyframe : keyframes_) {
    for (const LandmarkId id : state.frames[keyframe].matched) {
      const auto known = state.map.landmarks().find(id.value);
      if (known == state.map.landmarks().end() || known->second.state != LandmarkState::kConfirmed)
        continue;
      if (static_cast<int>(known->second.sightings.size()) >= options_.min_sightings)
        ids.insert(id.value);
    }
  }
  for (const int id : ids) {
    const MapLandmark& landmark = state.map.landmarks().at(id);
    const int object = static_cast<int>(problem.objects.size());
    problem.objects.push_back({id, landmark.symmetry, landmark.pose});
    for (std::size_t i = 0; i < keyframes_.size(); ++i) {
      const int frame = problem.cameras[i].frame;
      const auto at =
          std::lower_bound(landmark.sightings.begin(), landmark.sightings.end(), frame,
                           [](const Sighting& sighting, int f) { return sighting.frame < f; });
      if (at != landmark.sightings.end() && at->frame == frame &&
          landmark.state == LandmarkState::kConfirmed)
        problem.sightings.push_back({static_cast<int>(i), object, at->T_cam_object});
    }
  }
}

// Marginalises the oldest camera and the objects that no other camera of the window sees.
void SlidingWindow::Slide(MapState& state, const BaProblem& problem) {
  std::vector<int> gone_objects;
  for (int k = 0; k < static_cast<int>(problem.objects.size()); ++k) {
    const bool seen =
        std::any_of(problem.sightings.begin(), problem.sightings.end(),
                    [k](const BaSighting& s) { return s.object == k && s.camera > 0; });
    if (!seen) gone_objects.push_back(k);
  }
  prior_ = Marginalise(problem, {0}, gone_objects, ba_);
  const int left_behind = keyframes_.front();
  keyframes_.erase(keyframes_.begin());
  // Frames between keyframes follow the keyframe before them.
  FrameStore& frames = state.frames;
  const int to = keyframes_.empty() ? frames.size() : keyframes_.front();
  for (int i = left_behind + 1; i < to; ++i)
    frames.SetPose(i, PredictPose(frames[i - 1], frames[i].T_odom_cam, problem.log_scale));
}

}  // namespace sslcd
