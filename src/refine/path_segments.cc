// SPDX-License-Identifier: BSD-3-Clause
#include "refine/path_segments.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sslcd {

PathSegments::PathSegments(const MapState& state, double length_m) {
  for (const FrameRecord& record : state.frames)
    segment_of_frame_[record.frame] =
        length_m > 0 ? static_cast<int>(std::floor(record.travelled / length_m)) : 0;
  std::set<std::pair<int, int>> seen_both;  // by one landmark
  for (const auto& [id, landmark] : state.map.landmarks()) {
    const Segments& seen = seen_in_[id] = SegmentsOf(landmark);
    if (landmark.state != LandmarkState::kConfirmed) continue;
    for (const int a : seen)
      for (const int b : seen)
        if (std::abs(a - b) > 1) seen_both.insert({a, b});
  }
  for (const auto& [a, b] : seen_both)  // an object also links the neighbours of its segments
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) links_.insert({a + i, b + j});
}

PathSegments::Segments PathSegments::SegmentsOf(const MapLandmark& landmark) const {
  Segments segments;
  for (const Sighting& sighting : landmark.sightings) {
    const auto at = segment_of_frame_.find(sighting.frame);
    if (at != segment_of_frame_.end() && (segments.empty() || segments.back() != at->second))
      segments.push_back(at->second);
  }
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  return segments;
}

const PathSegments::Segments& PathSegments::SeenIn(LandmarkId landmark) const {
  static const Segments kNone;
  const auto known = seen_in_.find(landmark.value);
  return known == seen_in_.end() ? kNone : known->second;
}

bool PathSegments::Covisible(LandmarkId a, LandmarkId b) const {
  const Segments &of_a = SeenIn(a), &of_b = SeenIn(b);
  return std::any_of(of_a.begin(), of_a.end(), [&](int i) {
    return std::any_of(of_b.begin(), of_b.end(), [&](int j) { return Linked(i, j); });
  });
}

bool PathSegments::Covisible(const FrameRecord& frame, LandmarkId landmark) const {
  const auto at = segment_of_frame_.find(frame.frame);
  if (at == segment_of_frame_.end()) return false;
  const Segments& seen = SeenIn(landmark);
  return std::any_of(seen.begin(), seen.end(), [&](int j) { return Linked(at->second, j); });
}

void PathSegments::Fuse(LandmarkId keep, LandmarkId drop) {
  const Segments &a = SeenIn(keep), &b = SeenIn(drop);
  Segments both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  seen_in_[keep.value] = std::move(both);
}

}  // namespace sslcd
