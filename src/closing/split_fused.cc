// SPDX-License-Identifier: BSD-3-Clause
#include "closing/split_fused.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "closing/mean_place.h"
#include "map/association_inputs.h"

namespace sslcd {
namespace {

using Parts = std::map<int, MapLandmark>;  // by id

// The sighting in a frame, or where it would be.
std::vector<Sighting>::iterator Find(std::vector<Sighting>& sightings, int frame) {
  return std::lower_bound(sightings.begin(), sightings.end(), frame,
                          [](const Sighting& sighting, int f) { return sighting.frame < f; });
}
bool IsIn(const std::vector<Sighting>::iterator& at, const std::vector<Sighting>& sightings,
          int frame) {
  return at != sightings.end() && at->frame == frame;
}

// The landmark of a pass before any fusion, as it is now or, if it is gone, without sightings.
MapLandmark& OwnOf(const PassObject& pass, const ObjectMap& map, Parts& parts) {
  const auto known = parts.find(pass.own_id.value);
  if (known != parts.end()) return known->second;
  const auto now = map.landmarks().find(pass.own_id.value);
  MapLandmark own = now == map.landmarks().end() ? map.at(pass.id) : now->second;
  if (now == map.landmarks().end()) own.sightings.clear();
  own.id = pass.own_id;
  return parts.emplace(own.id.value, std::move(own)).first->second;
}

// Moves the sightings of a pass from the fused landmark to its own one. If another detection of a
// frame was kept when they were fused, the fused one keeps that.
void MoveSightings(const PassObject& pass, const FrameStore& frames, MapLandmark& fused,
                   MapLandmark& own) {
  for (const auto& [f, d] : pass.sightings) {
    const FrameRecord& frame = frames[f];
    const Sighting sighting = SightingOf(frame.frame, frame.stamp, frame.detections[d]);
    const auto from = Find(fused.sightings, frame.frame);
    if (!IsIn(from, fused.sightings, frame.frame)) continue;
    if (from->T_cam_object.translation() == sighting.T_cam_object.translation())
      fused.sightings.erase(from);
    const auto to = Find(own.sightings, frame.frame);
    if (!IsIn(to, own.sightings, frame.frame)) own.sightings.insert(to, sighting);
  }
}

// All landmarks that lose or get sightings, with the sightings that they will have.
Parts PartsOf(const MapState& state, const PassMap& passes) {
  Parts parts;
  for (const PassObject& pass : passes.passes()) {
    if (pass.own_id == pass.id) continue;
    MapLandmark& fused = parts.emplace(pass.id.value, state.map.at(pass.id)).first->second;
    MoveSightings(pass, state.frames, fused, OwnOf(pass, state.map, parts));
  }
  return parts;
}

void ReturnDetections(FrameStore& frames, const PassMap& passes) {
  for (const PassObject& pass : passes.passes()) {
    if (pass.own_id == pass.id) continue;
    for (const auto& [f, d] : pass.sightings) {
      std::vector<LandmarkId> matched = frames[f].matched;
      matched[d] = pass.own_id;
      frames.SetMatched(f, std::move(matched));
    }
  }
}

// Place and galleries by its passes.
void TakePasses(const MapState& state, const PassMap& passes, MapLandmark& part) {
  PassObject all;
  part.appearance = PerCue<Gallery>(Gallery(passes.galleries()));
  for (const int i : passes.PassesOf(part.id)) {
    const PassObject& pass = passes.passes()[i];
    all.sightings.insert(all.sightings.end(), pass.sightings.begin(), pass.sightings.end());
    for (const CueRow& row : kCueRows) part.appearance[row.cue].Merge(pass.appearance[row.cue]);
  }
  const PathRange everywhere{0, std::numeric_limits<double>::infinity(), 1};
  if (const auto place = MeanPlace(all, state, passes.noise(), everywhere)) part.pose = place->pose;
}

// The motion of a fused landmark may have been that from one object to another.
void TestMotion(const MapState& state, const std::map<int, int>& index_of_frame,
                const WholeMapOptions& options, MapLandmark& part) {
  part.motion = MotionTest();
  for (const Sighting& sighting : part.sightings) {
    const FrameRecord& frame = state.frames[index_of_frame.at(sighting.frame)];
    Detection detection;
    detection.T_cam_object = sighting.T_cam_object;
    const AssociationQuery query = QueryOf(detection, frame.T_world_cam, state.gravity(),
                                           options.noise, state.map.noise_scale());
    part.motion.Add(query.place.position, query.place.covariance, sighting.stamp,
                    options.map.motion);
    part.last_seen = sighting.stamp;
    part.last_seen_at = frame.travelled;
  }
  if (CanMove(part) && part.motion.Verdict(options.map.motion) == Motion::kDriving)
    part.state = LandmarkState::kDynamic;
  else if (part.state == LandmarkState::kDynamic)
    part.state = LandmarkState::kConfirmed;
}

}  // namespace

void SplitFused(MapState& state, PassMap& passes, const WholeMapOptions& options) {
  Parts parts = PartsOf(state, passes);
  if (parts.empty()) return;
  ReturnDetections(state.frames, passes);
  passes.Rebuild(state);
  std::map<int, int> index_of_frame;
  for (int f = 0; f < state.frames.size(); ++f) index_of_frame[state.frames[f].frame] = f;
  for (auto& [id, part] : parts) {
    if (part.sightings.empty()) {
      state.map.SetSightings({id}, {});
      continue;
    }
    TakePasses(state, passes, part);
    TestMotion(state, index_of_frame, options, part);
    state.map.Restore(std::move(part));
  }
}

}  // namespace sslcd
