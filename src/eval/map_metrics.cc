// SPDX-License-Identifier: BSD-3-Clause
#include "eval/map_metrics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "eval/identities.h"
#include "eval/iou3d.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

/// Boxes are compared in the camera's axes: the camera's own vertical, not the world's.
const GravityFrame kCameraAxes;

/// The boxes of one KITTI frame, in kCameraAxes.
struct Scene {
  std::vector<Cuboid> truth;
  std::vector<int> tracks;  // tracks of `truth`
  std::vector<Cuboid> detected, mapped;
};
using Scenes = std::map<int, Scene>;  // by frame number; only frames with annotated boxes

/// Index of the box nearest to `box`, if it is nearer than `gate`; on a tie the first.
std::optional<std::size_t> Nearest(const Cuboid& box, const std::vector<Cuboid>& boxes,
                                   double gate) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const double distance = HorizontalDistance(box, boxes[k]);
    if (distance < gate) {
      best = k;
      gate = distance;
    }
  }
  return best;
}

Scenes TrueScenes(const MapRun& run, const MapMetricOptions& options) {
  Scenes scenes;
  for (const GroundTruthBox& box : run.truth) {
    if (box.frame < 0)
      throw Error(ErrorKind::kUsage, "an annotated box has a negative frame number");
    if (std::find(options.labels.begin(), options.labels.end(), box.label) == options.labels.end())
      continue;
    Scene& scene = scenes[box.frame];
    scene.truth.push_back(ToCuboid(box.T_cam_object, box.dims, kCameraAxes));
    scene.tracks.push_back(box.track);
  }
  return scenes;
}

/// Diagonal of the box around each track's centres in the world. [m]
std::map<int, double> TrackExtents(const Scenes& scenes, const std::vector<Pose>& reference) {
  struct Range {
    Vec3 low, high;
  };
  std::map<int, Range> ranges;
  for (const auto& [frame, scene] : scenes) {
    if (frame >= static_cast<int>(reference.size())) continue;
    for (std::size_t k = 0; k < scene.truth.size(); ++k) {
      const Vec3 point = reference[frame] * (kCameraAxes.Basis() * scene.truth[k].centre);
      Range& range = ranges.emplace(scene.tracks[k], Range{point, point}).first->second;
      range = {range.low.cwiseMin(point), range.high.cwiseMax(point)};
    }
  }
  std::map<int, double> extents;
  for (const auto& [track, range] : ranges) extents[track] = (range.high - range.low).norm();
  return extents;
}

/// Matches of the detections with the annotated boxes.
struct Sightings {
  std::unordered_map<int, int> track_of_row;
  std::map<int, int> count;  // per track: detections with a sufficient score
};

/// Also fills in the detected boxes of the scenes.
Sightings TakeDetections(const MapRun& run, const MapMetricOptions& options, Scenes& scenes) {
  Sightings sightings;
  std::set<int> seen;
  for (const Frame& frame : run.frames) {
    if (!seen.insert(frame.index).second) {
      throw Error(ErrorKind::kUsage, "two frames have the number " + std::to_string(frame.index));
    }
    const auto scene = scenes.find(frame.index);
    if (scene == scenes.end()) continue;
    for (const Detection& detection : frame.detections) {
      const Cuboid box = ToCuboid(detection.T_cam_object, detection.dims, kCameraAxes);
      const bool counts = detection.score >= options.min_score;
      if (counts) scene->second.detected.push_back(box);
      const auto nearest = Nearest(box, scene->second.truth, options.identity_gate_m);
      if (!nearest) continue;
      const int track = scene->second.tracks[*nearest];
      sightings.track_of_row[detection.row] = track;
      sightings.count[track] += counts;
    }
  }
  return sightings;
}

/// Puts each confirmed object into the frames that observed it, as seen from the estimated pose.
void PlaceObjects(const MapRun& run, Scenes& scenes) {
  for (const MapObject& object : run.objects) {
    if (object.state != LandmarkState::kConfirmed) continue;
    std::set<int> frames;
    for (const Observation& observation : object.observations) frames.insert(observation.frame);
    for (const int frame : frames) {
      const auto scene = scenes.find(frame);
      if (scene == scenes.end() || frame >= static_cast<int>(run.estimate.size())) continue;
      const Pose T_cam_object = run.estimate[frame].inverse() * object.T_world_object;
      scene->second.mapped.push_back(ToCuboid(T_cam_object, object.dims, kCameraAxes));
    }
  }
}

class Mean {
 public:
  void Add(double value) {
    sum_ += value;
    ++count_;
  }
  int count() const { return count_; }
  std::optional<double> value() const {
    return count_ > 0 ? std::optional<double>(sum_ / count_) : std::nullopt;
  }

 private:
  double sum_ = 0;
  int count_ = 0;
};

void CompareBoxes(const MapRun& run, const MapMetricOptions& options, const Scenes& scenes,
                  const std::set<int>& static_tracks, MapMetrics& metrics) {
  Mean raw, raw_same_pairs, map;
  for (const auto& [frame, scene] : scenes) {
    if (frame >= static_cast<int>(run.estimate.size())) break;
    for (std::size_t k = 0; k < scene.truth.size(); ++k) {
      if (!static_tracks.count(scene.tracks[k])) continue;
      const Cuboid& truth = scene.truth[k];
      const auto detected = Nearest(truth, scene.detected, options.box_gate_m);
      if (!detected) continue;
      const double iou_raw = Iou3d(truth, scene.detected[*detected]);
      raw.Add(iou_raw);
      const auto mapped = Nearest(truth, scene.mapped, options.box_gate_m);
      if (!mapped) continue;
      map.Add(Iou3d(truth, scene.mapped[*mapped]));
      raw_same_pairs.Add(iou_raw);
    }
  }
  metrics.iou_raw = raw.value();
  metrics.iou_raw_same_pairs = raw_same_pairs.value();
  metrics.iou_map = map.value();
  metrics.pairs = raw.count();
  metrics.coverage = static_cast<double>(map.count()) / std::max(1, raw.count());
}

/// Counts the tracks with enough detections, those of them that own landmarks, and their landmarks.
struct Found {
  int objects = 0, owners = 0, landmarks = 0;
};

Found CountFound(const std::set<int>& tracks, const Sightings& sightings,
                 const Identities& identities, int min_sightings) {
  Found found;
  for (const int track : tracks) {
    const auto count = sightings.count.find(track);
    if (count == sightings.count.end() || count->second < min_sightings) continue;
    ++found.objects;
    const auto owned = identities.owned.find(track);
    if (owned == identities.owned.end()) continue;
    ++found.owners;
    found.landmarks += owned->second;
  }
  return found;
}

}  // namespace

MapMetrics ComputeMapMetrics(const MapRun& run, const MapMetricOptions& options) {
  Scenes scenes = TrueScenes(run, options);
  std::set<int> static_tracks, driving_tracks;
  for (const auto& [track, extent] : TrackExtents(scenes, run.reference)) {
    if (extent < options.static_below_m) static_tracks.insert(track);
    if (extent > options.driving_above_m) driving_tracks.insert(track);
  }
  const Sightings sightings = TakeDetections(run, options, scenes);
  PlaceObjects(run, scenes);

  MapMetrics metrics;
  CompareBoxes(run, options, scenes, static_tracks, metrics);

  const Identities identities = FindIdentities(run.objects, [&](int row) -> std::optional<int> {
    const auto track = sightings.track_of_row.find(row);
    return track == sightings.track_of_row.end() ? std::nullopt : std::optional<int>(track->second);
  });
  const Found parked = CountFound(static_tracks, sightings, identities, options.min_sightings);
  const Found driving = CountFound(driving_tracks, sightings, identities, options.min_sightings);
  metrics.landmarks = identities.landmarks;
  metrics.purity = identities.Purity();
  metrics.static_objects = parked.objects;
  metrics.static_found = static_cast<double>(parked.owners) / std::max(1, parked.objects);
  metrics.landmarks_per_static = static_cast<double>(parked.landmarks) / std::max(1, parked.owners);
  metrics.driving_in_map = static_cast<double>(driving.owners) / std::max(1, driving.objects);
  return metrics;
}

}  // namespace sslcd
