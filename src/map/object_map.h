// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "map/association_inputs.h"
#include "map/landmark_store.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/map/options.h"

namespace sslcd {

/// The landmarks of a run and the association of detections with them; the state of the mapping
/// stage.
class ObjectMap {
 public:
  ObjectMap(const GravityFrame& gravity, const LabelTable& labels, const DetectionNoise& noise,
            const AssociationOptions& association, const MapOptions& options);

  /// Associates the detections of a frame with pose T_world_cam and updates, creates and drops
  /// landmarks. `camera` may be null; then association does not use 2D boxes. `frame` and `stamp`
  /// [s] must increase from call to call; `travelled_m` is the path length so far.
  MapUpdate AddFrame(int frame, double stamp, const Pose& T_world_cam,
                     const std::vector<Detection>& detections, const Camera* camera,
                     double travelled_m = 0);

  /// Associates detections with the current confirmed landmarks without changing them. Returns the
  /// landmark of each detection (-1: none). `may` selects the allowed landmarks; empty: all.
  std::vector<LandmarkId> Match(double stamp, const Pose& T_world_cam,
                                const std::vector<Detection>& detections, const Camera* camera,
                                const std::function<bool(const MapLandmark&)>& may = {}) const;

  const GravityFrame& gravity() const { return gravity_; }
  const NoiseScale& noise_scale() const { return noise_scale_; }
  void SetNoiseScale(const NoiseScale& scale) { noise_scale_ = scale; }

  // The landmarks: see LandmarkStore.
  const std::map<int, MapLandmark>& landmarks() const { return landmarks_.all(); }
  const MapLandmark& at(LandmarkId id) const { return landmarks_.at(id); }
  int rewrites() const { return landmarks_.rewrites(); }
  void ReserveIds(const ObjectMap& other) { landmarks_.ReserveIds(other.landmarks_); }
  LandmarkId Insert(MapLandmark landmark) { return landmarks_.Insert(std::move(landmark)); }
  void Restore(MapLandmark landmark) { landmarks_.Restore(std::move(landmark)); }
  void SetPose(LandmarkId id, const UprightPose& pose) { landmarks_.SetPose(id, pose); }
  void SetState(LandmarkId id, LandmarkState state) { landmarks_.SetState(id, state); }
  void SetSightings(LandmarkId id, std::vector<Sighting> sightings) {
    landmarks_.SetSightings(id, std::move(sightings));
  }
  void Fuse(LandmarkId keep, LandmarkId drop) { landmarks_.Fuse(keep, drop); }
  std::optional<LandmarkId> Current(LandmarkId id) const { return landmarks_.Current(id); }
  std::vector<LandmarkId> FindWithin(const Vec3& point_world, double radius_m) const {
    return landmarks_.FindWithin(Horizontal(point_world, gravity_), radius_m);
  }

 private:
  std::vector<AssociationQuery> QueriesOf(const std::vector<Detection>& detections,
                                          const FrameView& view) const;
  std::vector<LandmarkId> CandidateIds(const std::vector<AssociationQuery>& queries) const;
  std::vector<LandmarkId> MatchIds(const std::vector<AssociationQuery>& queries,
                                   const std::vector<LandmarkId>& ids, const FrameView& view) const;
  LandmarkId Create(const AssociationQuery& query, const FrameView& view);
  void Update(MapLandmark& landmark, const AssociationQuery& query, const FrameView& view);
  void UpdateState(MapLandmark& landmark, MapUpdate& update);

  GravityFrame gravity_;
  LabelTable labels_;
  DetectionNoise noise_;
  AssociationOptions association_;
  MapOptions options_;
  NoiseScale noise_scale_;
  LandmarkStore landmarks_;
};

}  // namespace sslcd
