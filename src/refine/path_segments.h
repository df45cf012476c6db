// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "map/map_state.h"

namespace sslcd {

/// Decides which segments of the path may observe the same place: neighbouring segments, and
/// segments linked by a landmark that a loop closure has fused. Between other segments the drift is
/// unknown, so that equal positions are no evidence of equal objects.
class PathSegments {
 public:
  /// Segments of `length_m` of odometry path; <= 0: everything is one segment. O(all sightings).
  PathSegments(const MapState& state, double length_m);

  /// Of landmarks with the sightings that they had, Fuse() apart.
  bool Covisible(LandmarkId a, LandmarkId b) const;
  bool Covisible(const FrameRecord& frame, LandmarkId landmark) const;

  /// To be called when a landmark gets the sightings of another one.
  void Fuse(LandmarkId keep, LandmarkId drop);

 private:
  using Segments = std::vector<int>;  // ascending

  Segments SegmentsOf(const MapLandmark& landmark) const;
  const Segments& SeenIn(LandmarkId landmark) const;
  bool Linked(int a, int b) const { return (a - b <= 1 && b - a <= 1) || links_.count({a, b}) > 0; }

  std::map<int, int> segment_of_frame_;
  std::map<int, Segments> seen_in_;  // by landmark
  std::set<std::pair<int, int>> links_;
};

}  // namespace sslcd
