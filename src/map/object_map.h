// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "association/associate.h"
#include "association/spatial_index.h"
#include "map/map_landmark.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/map/options.h"

namespace sslcd {

/// Gates and the motion test use larger sigmas than the learnt ones. kNoiseCaution is a factor on
/// them: errors vary with range and viewpoint, so successive errors correlate. kLongTailScale is
/// added in quadrature: errors of good detectors have long tails. Both were set by hand without a
/// recorded search.
inline constexpr double kNoiseCaution = 1.5, kLongTailScale = 3.;

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

  const std::map<int, MapLandmark>& landmarks() const { return landmarks_; }
  const MapLandmark& at(LandmarkId id) const { return landmarks_.at(id.value); }
  const GravityFrame& gravity() const { return gravity_; }
  const NoiseScale& noise_scale() const { return noise_scale_; }

  /// Counts replaced sightings and fused landmarks. A change invalidates data that was computed
  /// from landmarks by id.
  int rewrites() const { return rewrites_; }

  /// Sets the result of an optimisation.
  void SetPose(LandmarkId id, const UprightPose& pose);
  void SetState(LandmarkId id, LandmarkState state);
  void SetNoiseScale(const NoiseScale& scale) { noise_scale_ = scale; }

  /// Merges `drop` into `keep` with its sightings and galleries. If both were seen in the same
  /// frame, `keep`'s sighting stays.
  void Fuse(LandmarkId keep, LandmarkId drop);

  /// Replaces a landmark's sightings, e.g. after a new association. An empty list removes the
  /// landmark.
  void SetSightings(LandmarkId id, std::vector<Sighting> sightings);

  /// Adds an existing landmark, e.g. of a loaded map. Returns its new id.
  LandmarkId Insert(MapLandmark landmark);

  /// Ids of landmarks within a horizontal distance of a point, ascending.
  std::vector<LandmarkId> Near(const Vec3& point_world, double radius_m) const;

 private:
  struct View;  // data common to all detections of a frame
  AssociationQuery QueryOf(const Detection& detection, const View& view) const;
  AssociationCandidate CandidateOf(const MapLandmark& landmark, const View& view) const;
  std::vector<int> CandidateIds(const std::vector<AssociationQuery>& queries) const;
  std::vector<int> MatchIds(const std::vector<AssociationQuery>& queries, std::vector<int> ids,
                            const View& view) const;
  std::vector<AssociationQuery> QueriesOf(const std::vector<Detection>& detections,
                                          const View& view) const;
  void Create(const AssociationQuery& query, const View& view);
  void Update(MapLandmark& landmark, const AssociationQuery& query, const View& view);
  void Judge(MapLandmark& landmark, MapUpdate& update);
  void Retire(double stamp);
  void Reindex(const MapLandmark& landmark, double stamp);
  Vec2 Horizontal(const Vec3& world) const {
    return {world.dot(gravity_.forward), world.dot(gravity_.left)};
  }
  bool Movable(const MapLandmark& landmark) const { return landmark.symmetry != Symmetry::kFull; }

  GravityFrame gravity_;
  LabelTable labels_;
  DetectionNoise noise_;
  AssociationOptions association_;
  MapOptions options_;
  NoiseScale noise_scale_;
  std::map<int, MapLandmark> landmarks_;
  std::vector<int> open_;  ///< tentative and driving landmarks: the only ones that can become stale
  SpatialIndex index_;
  int next_id_ = 1;
  int rewrites_ = 0;
};

}  // namespace sslcd
