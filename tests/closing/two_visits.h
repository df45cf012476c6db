// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "closing/pass_layout.h"

namespace sslcd {

/// A camera drives past one place twice, 300 m of path between the visits: frames 0..9 and
/// 300..309, a metre a frame. World axes are the first camera's (y down); layouts have x = world x,
/// y = world z.
struct TwoVisits {
  std::vector<FrameRecord> to_come;
  MapState state{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), {}};
  ObjectMap& map = state.map;
  PassMap passes{{}, 30.};

  TwoVisits() {
    for (const int first : {0, 300})
      for (int i = 0; i < 10; ++i) Plan(first + i, first + i, Pose::Trans(0, 0, i));
  }

  void Plan(int frame, double path_m, const Pose& T_world_cam) {
    FrameRecord record;
    record.frame = frame;
    record.T_odom_cam = Pose::Trans(0, 0, path_m);
    record.T_world_cam = T_world_cam;
    to_come.push_back(record);
  }

  LandmarkId Add(const Vec3& position, const std::string& label = "Tree", double yaw = 0) {
    MapLandmark landmark;
    landmark.label = label;
    landmark.symmetry = label == "Tree" ? Symmetry::kFull : Symmetry::kNone;
    landmark.state = LandmarkState::kConfirmed;
    landmark.pose = {position, yaw};
    return map.Insert(landmark);
  }

  /// Will be seen by the frames numbered from `first` to before `end`, without error with respect
  /// to where they are now.
  void See(LandmarkId id, int first, int end) {
    for (FrameRecord& record : to_come) {
      if (record.frame < first || record.frame >= end) continue;
      Detection detection;
      detection.T_cam_object =
          record.T_world_cam.inverse() * ToPose(map.at(id).pose, map.gravity());
      record.detections.push_back(detection);
      record.matched.push_back(id);
    }
  }

  /// The next frames come in one by one; the store keeps their detections without appearance.
  void Drive(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      FrameRecord record = to_come.front();
      to_come.erase(to_come.begin());
      const std::vector<Detection> seen = record.detections;
      for (Detection& detection : record.detections) detection.appearance = {};
      state.frames.Append(record);
      passes.AddFrame(state, seen);
    }
  }
  void Drive() { Drive(to_come.size()); }

  /// The second visit with drifted odometry.
  void ShiftSecondVisit(const Vec3& by) {
    for (FrameRecord& record : to_come)
      if (record.frame >= 300) record.T_world_cam = Pose::Trans(by) * record.T_world_cam;
  }
  void Move(int from, const Pose& motion) {
    for (int f = from; f < state.frames.size(); ++f)
      state.frames.SetPose(f, motion * state.frames[f].T_world_cam);
  }
  void Rematch(LandmarkId from, LandmarkId to) {
    for (int f = 0; f < state.frames.size(); ++f) {
      std::vector<LandmarkId> matched = state.frames[f].matched;
      for (LandmarkId& id : matched)
        if (id == from) id = to;
      state.frames.SetMatched(f, matched);
    }
    for (FrameRecord& record : to_come)
      for (LandmarkId& id : record.matched)
        if (id == from) id = to;
  }

  PassLayout Recent(double from_m, int min_sightings) const {
    return PassLayouts(passes, state).Recent(from_m, min_sightings);
  }
  PassLayout Before(double to_m, int min_sightings) const {
    return PassLayouts(passes, state).Before(to_m, min_sightings);
  }
  PassLayout Between(double from_m, double to_m, int min_sightings) const {
    return PassLayouts(passes, state).Between(from_m, to_m, min_sightings);
  }
};

}  // namespace sslcd
