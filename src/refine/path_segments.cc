// SPDX-License-Identifier: BSD-3-Clause
#include "refine/path_segments.h"

#include <algorithm>
#include <cmath>

namespace sslcd {

PathSegments::PathSegments(const MapState& state, double length_m) {
  for (const FrameRecord& record : state.frames)
    segment_of_frame_[record.frame] =
        length_m > 0 ? static_cast<int>(std::floor(record.travelled / length_m)) : 0;
  for (const auto& [id, landmark] : state.map.landmarks()) {
    if (landmark.state != LandmarkState::kConfirmed) continue;
    const std::set<int> seen = SegmentsOf(landmark);
    if (seen.size() < 2) continue;
    for (const int a : seen)
      for (const int b : seen)
        if (std::abs(a - b) > 1)  // an object also links the neighbours of its segments
          for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j) links_.insert({a + i, b + j});
  }
}

std::set<int> PathSegments::SegmentsOf(const MapLandmark& landmark) const {
  std::set<int> segments;
  for (const Sighting& sighting : landmark.sightings) {
    const auto at = segment_of_frame_.find(sighting.frame);
    if (at != segment_of_frame_.end()) segments.insert(at->second);
  }
  return segments;
}

bool PathSegments::Covisible(const MapLandmark& a, const MapLandmark& b) const {
  const std::set<int> of_a = SegmentsOf(a), of_b = SegmentsOf(b);
  return std::any_of(of_a.begin(), of_a.end(), [&](int i) {
    return std::any_of(of_b.begin(), of_b.end(), [&](int j) { return Linked(i, j); });
  });
}

bool PathSegments::Covisible(const FrameRecord& frame, const MapLandmark& landmark) const {
  const auto at = segment_of_frame_.find(frame.frame);
  if (at == segment_of_frame_.end()) return false;
  const std::set<int> seen = SegmentsOf(landmark);
  return std::any_of(seen.begin(), seen.end(), [&](int j) { return Linked(at->second, j); });
}

}  // namespace sslcd
