// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <utility>

#include "map/map_state.h"

namespace sslcd {

/// Decides which segments of the path may observe the same place: neighbouring segments, and
/// segments linked by a landmark that a loop closure has fused. Between other segments the drift is
/// unknown, so that equal positions are no evidence of equal objects.
class PathSegments {
 public:
  /// Segments of `length_m` of odometry path; <= 0: everything is one segment.
  PathSegments(const MapState& state, double length_m);

  bool Covisible(const MapLandmark& a, const MapLandmark& b) const;
  bool Covisible(const FrameRecord& frame, const MapLandmark& landmark) const;

 private:
  std::set<int> SegmentsOf(const MapLandmark& landmark) const;
  bool Linked(int a, int b) const { return (a - b <= 1 && b - a <= 1) || links_.count({a, b}) > 0; }

  std::map<int, int> segment_of_frame_;
  std::set<std::pair<int, int>> links_;
};

}  // namespace sslcd
