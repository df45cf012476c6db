// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "association/spatial_index.h"
#include "map/map_landmark.h"
#include "sslcd/core/pose.h"
#include "sslcd/map/options.h"

namespace sslcd {

/// The landmarks of a map by id, and where they are. Ids start at 1 and ascend. Copyable.
class LandmarkStore {
 public:
  LandmarkStore(const GravityFrame& gravity, const MotionTestOptions& motion)
      : gravity_(gravity), motion_(motion) {}

  const std::map<int, MapLandmark>& all() const { return landmarks_; }
  const MapLandmark& at(LandmarkId id) const { return landmarks_.at(id.value); }
  /// To change it. Index() must follow a change of place; states change by SetState.
  MapLandmark& at(LandmarkId id) { return landmarks_.at(id.value); }

  /// Counts replaced sightings, and fused and restored landmarks. A change invalidates data that
  /// was computed from landmarks by id.
  int rewrites() const { return rewrites_; }

  /// New landmarks get no id that `other` has used.
  void ReserveIds(const LandmarkStore& other) { next_id_ = std::max(next_id_, other.next_id_); }

  /// Adds an existing landmark, e.g. of a loaded map. Returns its new id.
  LandmarkId Insert(MapLandmark landmark);

  /// Puts a landmark under an id that it has had before, e.g. after the split of a fused one.
  /// Replaces one that has this id now. Needs at least one sighting.
  void Restore(MapLandmark landmark);

  /// Sets the result of an optimisation. The motion test moves with the pose.
  void SetPose(LandmarkId id, const UprightPose& pose);
  void SetState(LandmarkId id, LandmarkState state);

  /// Replaces a landmark's sightings, e.g. after a new association. An empty list removes the
  /// landmark.
  void SetSightings(LandmarkId id, std::vector<Sighting> sightings);

  /// Merges `drop` into `keep` with its sightings and galleries. If both were seen in the same
  /// frame, `keep`'s sighting stays.
  void Fuse(LandmarkId keep, LandmarkId drop);

  /// The landmark that an id names now: itself, or the one that it was fused into. None if it was
  /// removed.
  std::optional<LandmarkId> Current(LandmarkId id) const;

  /// Makes a landmark found where it is at `stamp` [s], a driving one where it is predicted.
  void Index(const MapLandmark& landmark, double stamp);
  /// The same for all landmarks that can become stale.
  void IndexOpen(double stamp);

  /// Lets tentative and driving landmarks unseen for more than `stale_after_s` at `stamp` [s] be
  /// found no more. Tentative ones become stale.
  void Retire(double stamp, double stale_after_s);

  /// Ids of landmarks within a distance of a point of the horizontal plane, ascending.
  std::vector<LandmarkId> FindWithin(const Vec2& place, double radius_m) const;

 private:
  void Put(MapLandmark landmark);

  GravityFrame gravity_;
  MotionTestOptions motion_;
  std::map<int, MapLandmark> landmarks_;
  std::map<int, int> fused_into_;  ///< of landmarks that were fused and not restored since
  std::vector<int> open_;  ///< tentative and driving landmarks: the only ones that can become stale
  SpatialIndex index_;
  int next_id_ = 1;
  int rewrites_ = 0;
};

}  // namespace sslcd
