// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refine_map.h"

#include <cmath>
#include <map>
#include <utility>

#include "core/median.h"
#include "refine/fuse.h"
#include "refine/path_segments.h"
#include "refine/trajectory_correction.h"

namespace sslcd {
namespace {

// Confirms landmarks with enough sightings that are not driving, for which the stream ended too
// early.
void ConfirmAll(ObjectMap& map, const WholeMapOptions& all) {
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
    map.SetPose(id, map.at(id).pose);  // updates the spatial index
  }
  for (const LandmarkId id : drop) map.SetState(id, LandmarkState::kStale);
}

// Associates every detection that does not belong to a driving object again, with the refined
// poses.
void AssociateAgain(MapState& state, const WholeMapOptions& options, const Camera* camera) {
  ObjectMap& map = state.map;
  const PathSegments segments(state, options.map.memory_m);
  std::map<int, std::vector<Sighting>> sightings;
  for (int f = 0; f < state.frames.size(); ++f) {
    const FrameRecord& record = state.frames[f];
    std::vector<LandmarkId> all_matched = record.matched;
    std::vector<Detection> open;
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < record.detections.size(); ++i) {
      const auto owner = map.landmarks().find(record.matched[i].value);
      if (owner != map.landmarks().end() && owner->second.state == LandmarkState::kDynamic)
        continue;
      open.push_back(record.detections[i]);
      index.push_back(i);
    }
    const auto covisible = [&](const MapLandmark& landmark) {
      return segments.Covisible(record, landmark.id);
    };
    const std::vector<LandmarkId> matched =
        map.Match(record.stamp, record.T_world_cam, open, camera, covisible);
    for (std::size_t k = 0; k < open.size(); ++k) {
      all_matched[index[k]] = matched[k];
      if (matched[k].value < 0) continue;
      sightings[matched[k].value].push_back(SightingOf(record.frame, record.stamp, open[k]));
    }
    state.frames.SetMatched(f, std::move(all_matched));
  }
  std::vector<LandmarkId> confirmed;
  for (const auto& [id, landmark] : map.landmarks())
    if (landmark.state == LandmarkState::kConfirmed) confirmed.push_back({id});
  for (const LandmarkId id : confirmed) map.SetSightings(id, std::move(sightings[id.value]));
}

// Compares the early and the late positions of a landmark.
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

// Share of the frames between its sightings in which a landmark was seen. Ignores frames without
// any detection, in which the detector may not have run, and gaps of more than two seconds, in
// which the landmark was out of sight. `detector_runs` has the number of frames with detections up
// to each frame.
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

void RejectMoved(MapState& state, const WholeMapOptions& options) {
  ObjectMap& map = state.map;
  std::map<int, Pose> cameras;
  std::map<int, int> detector_runs;
  int runs = 0;
  for (const FrameRecord& record : state.frames) {
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

BaSummary RefineMap(MapState& state, double& log_scale, const LoopEvidence& loops,
                    const WholeMapOptions& options, const Camera* camera) {
  ConfirmAll(state.map, options);
  const std::vector<int> keyframes =
      SelectKeyframes(state.frames, options.refine.keyframe_m, options.refine.keyframe_rad);
  BaSummary summary = OptimiseMap(state, keyframes, log_scale, loops, options);
  for (int round = 0; round < options.refine.rounds; ++round) {
    RejectMoved(state, options);
    FuseDuplicates(state, options);
    AssociateAgain(state, options, camera);
    ConfirmAll(state.map, options);
    summary = OptimiseMap(state, keyframes, log_scale, loops, options);
  }
  return summary;
}

}  // namespace sslcd
