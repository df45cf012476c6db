// SPDX-License-Identifier: BSD-3-Clause
#include "map/landmark_store.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sslcd {

LandmarkId LandmarkStore::Insert(MapLandmark landmark) {
  landmark.id = {next_id_++};
  const LandmarkId id = landmark.id;
  Put(std::move(landmark));
  return id;
}

void LandmarkStore::Restore(MapLandmark landmark) {
  assert(landmark.id.value < next_id_);
  ++rewrites_;
  open_.erase(std::remove(open_.begin(), open_.end(), landmark.id.value), open_.end());
  landmark.dims = FuseDims(landmark.sightings);
  Put(std::move(landmark));
}

void LandmarkStore::Put(MapLandmark landmark) {
  const int id = landmark.id.value;
  const Vec2 place = Horizontal(landmark.pose.position, gravity_);
  index_.Put(id, place.x(), place.y());
  if (landmark.state != LandmarkState::kConfirmed) open_.push_back(id);
  fused_into_.erase(id);
  landmarks_.insert_or_assign(id, std::move(landmark));
}

void LandmarkStore::SetPose(LandmarkId id, const UprightPose& pose) {
  MapLandmark& landmark = landmarks_.at(id.value);
  landmark.motion.Shift(Horizontal(pose.position, gravity_) -
                        Horizontal(landmark.pose.position, gravity_));
  landmark.pose = pose;
  Index(landmark, landmark.last_seen);
}

void LandmarkStore::SetState(LandmarkId id, LandmarkState state) {
  MapLandmark& landmark = landmarks_.at(id.value);
  if (landmark.state == state) return;
  landmark.state = state;
  const auto place = std::find(open_.begin(), open_.end(), id.value);
  if (state == LandmarkState::kConfirmed) {
    if (place != open_.end()) open_.erase(place);
  } else if (place == open_.end()) {
    open_.push_back(id.value);
  }
}

void LandmarkStore::SetSightings(LandmarkId id, std::vector<Sighting> sightings) {
  ++rewrites_;
  if (sightings.empty()) {
    index_.Remove(id.value);
    open_.erase(std::remove(open_.begin(), open_.end(), id.value), open_.end());
    landmarks_.erase(id.value);
    return;
  }
  MapLandmark& landmark = landmarks_.at(id.value);
  landmark.sightings = std::move(sightings);
  landmark.dims = FuseDims(landmark.sightings);
}

void LandmarkStore::Fuse(LandmarkId keep, LandmarkId drop) {
  MapLandmark& kept = landmarks_.at(keep.value);
  const MapLandmark& dropped = landmarks_.at(drop.value);
  std::map<int, Sighting> by_frame;
  for (const Sighting& sighting : dropped.sightings) by_frame[sighting.frame] = sighting;
  for (const Sighting& sighting : kept.sightings) by_frame[sighting.frame] = sighting;
  std::vector<Sighting> merged;
  for (const auto& [frame, sighting] : by_frame) merged.push_back(sighting);
  for (const CueRow& row : kCueRows)
    kept.appearance[row.cue].Merge(dropped.appearance[row.cue], dropped.pose.yaw - kept.pose.yaw);
  kept.last_seen = std::max(kept.last_seen, dropped.last_seen);
  kept.last_seen_at = std::max(kept.last_seen_at, dropped.last_seen_at);
  SetSightings(drop, {});
  SetSightings(keep, std::move(merged));
  fused_into_[drop.value] = keep.value;
}

std::optional<LandmarkId> LandmarkStore::Current(LandmarkId id) const {
  while (landmarks_.count(id.value) == 0) {
    const auto into = fused_into_.find(id.value);
    if (into == fused_into_.end()) return std::nullopt;
    id.value = into->second;
  }
  return id;
}

void LandmarkStore::Index(const MapLandmark& landmark, double stamp) {
  const Vec2 place = landmark.state == LandmarkState::kDynamic
                         ? landmark.motion.PredictDriving(stamp, motion_).position
                         : Horizontal(landmark.pose.position, gravity_);
  index_.Put(landmark.id.value, place.x(), place.y());
}

void LandmarkStore::IndexOpen(double stamp) {
  for (const int id : open_) Index(landmarks_.at(id), stamp);
}

void LandmarkStore::Retire(double stamp, double stale_after_s) {
  std::vector<int> still_open;
  for (const int id : open_) {
    MapLandmark& landmark = landmarks_.at(id);
    if (stamp - landmark.last_seen <= stale_after_s) {
      still_open.push_back(id);
      continue;
    }
    if (landmark.state == LandmarkState::kTentative) landmark.state = LandmarkState::kStale;
    index_.Remove(id);
  }
  open_ = std::move(still_open);
}

std::vector<LandmarkId> LandmarkStore::FindWithin(const Vec2& place, double radius_m) const {
  std::vector<LandmarkId> ids;
  for (const int id : index_.FindWithin(place.x(), place.y(), radius_m)) ids.push_back({id});
  return ids;
}

}  // namespace sslcd
