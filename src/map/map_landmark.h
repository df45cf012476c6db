// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "association/gallery.h"
#include "map/motion_test.h"
#include "sslcd/core/cue.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/label.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// One detection that was matched to a landmark, reduced to the data of bundle adjustment.
struct Sighting {
  int frame = 0;
  double stamp = 0;  ///< [s]
  int detection_row = 0;
  double score = 1.;
  Pose T_cam_object;
  Vec3 dims{0, 0, 0};  ///< length, width, height [m]
};

/// The sighting of a detection in a frame.
inline Sighting SightingOf(int frame, double stamp, const Detection& detection) {
  return {frame, stamp, detection.row, detection.score, detection.T_cam_object, detection.dims};
}

/// A landmark of the map under construction: the paper's o_k = {l, u, b, H, E, T_wo} (III-B) with
/// its state.
struct MapLandmark {
  LandmarkId id;
  std::string label;
  Symmetry symmetry = Symmetry::kNone;
  LandmarkState state = LandmarkState::kTentative;
  UprightPose pose;    ///< in the world
  Vec3 dims{0, 0, 0};  ///< length, width, height [m]
  MotionTest motion;
  PerCue<Gallery> appearance;       ///< H_k, E_k
  std::vector<Sighting> sightings;  ///< in frame order, at most one per frame
  double last_seen = 0;             ///< [s]
  double last_seen_at = 0;          ///< path length at that time [m]
};

/// Whether objects of its kind move at all: those round about the vertical (trees, poles) do not.
inline bool CanMove(const MapLandmark& landmark) { return landmark.symmetry != Symmetry::kFull; }

/// The part of a point or vector of the world in the horizontal plane: (forward, left). [m]
inline Vec2 Horizontal(const Vec3& world, const GravityFrame& gravity) {
  return {world.dot(gravity.forward), world.dot(gravity.left)};
}

/// Fuses the sizes of the sightings: the weighted median of each dimension, followed by one robust
/// mean around it. Weights decrease with range, like the precision of detections. Needs at least
/// one sighting.
Vec3 FuseDims(const std::vector<Sighting>& sightings);

/// Resolves front and back of an object by a vote of its sightings, since a detector may confuse
/// them and bundle adjustment ignores half turns. `headings` are the sightings' (forward, left) in
/// the world, of any length. Returns `yaw` or `yaw + pi`, wrapped.
double VoteHeading(double yaw, const std::vector<Vec2>& headings);

}  // namespace sslcd
