// SPDX-License-Identifier: BSD-3-Clause
#include "change/sightings.h"

#include <cmath>

#include "core/finite.h"

namespace sslcd {

void SessionLooks::Merge(const SessionLooks& other, double turn_rad) {
  for (const CueRow& row : kCueRows) views[row.cue].Merge(other.views[row.cue], turn_rad);
  const bool same_way = std::cos(turn_rad) >= 0;
  ahead += same_way ? other.ahead : other.reversed;
  reversed += same_way ? other.reversed : other.ahead;
  sightings += other.sightings;
}

Sightings::Sightings(HistoryWorld world) : world_(std::move(world)) {
  for (std::size_t i = 0; i < world_.objects.size(); ++i) {
    landmarks_.emplace_back();
    landmarks_.back().sessions.resize(world_.sessions);
    for (const Observation& seen : world_.objects[i].observations)
      landmark_of_[{seen.frame, seen.detection_row}] = static_cast<int>(i);
  }
}

void Sightings::AddFrame(const HistoryFrame& frame) {
  FrameSightings kept{frame.session, frame.map, frame.stamp, frame.T_world_cam, {}, {}};
  for (const Detection& detection : frame.detections) {
    if (!HasValidGeometry(detection)) continue;  // as in the mapper
    const auto found = landmark_of_.find({frame.number, detection.row});
    if (found == landmark_of_.end()) {
      kept.passing.push_back(SilhouetteOf(detection.T_cam_object, detection.dims));
      continue;
    }
    kept.landmarks.push_back(found->second);
    AddSighting(frame, detection, found->second);
  }
  frames_.push_back(std::move(kept));
}

void Sightings::AddSighting(const HistoryFrame& frame, const Detection& detection, int number) {
  const Pose& T_world_object = world_.objects[number].T_world_object;
  LandmarkSightings& landmark = landmarks_[number];
  landmark.map = frame.map;
  landmark.frames.push_back(frame.number);
  const Vec3& place = detection.T_cam_object.translation();
  const Eigen::Matrix3d R = frame.T_world_cam.so3().matrix();
  landmark.information +=
      R * PositionInformation(place, SigmasAt(place.norm(), DetectionNoise(), world_.noise)) *
      R.transpose();
  SessionLooks& looks = landmark.sessions[frame.session];
  const Vec3 camera = T_world_object.inverse() * frame.T_world_cam.translation();
  for (const CueRow& row : kCueRows)
    looks.views[row.cue].Add(detection.appearance[row.cue], std::atan2(camera.y(), camera.x()));
  const double turn = world_.gravity.YawOf((frame.T_world_cam * detection.T_cam_object).so3()) -
                      world_.gravity.YawOf(T_world_object.so3());
  ++(std::cos(turn) >= 0 ? looks.ahead : looks.reversed);
  ++looks.sightings;
}

}  // namespace sslcd
