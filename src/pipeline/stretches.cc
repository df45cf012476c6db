// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stretches.h"

#include <algorithm>
#include <cmath>

namespace sslcd {

Stretches::Stretches(const ObjectMap& map, const std::vector<FrameRecord>& frames,
                     double length_m) {
  for (const FrameRecord& record : frames)
    of_frame_[record.frame] =
        length_m > 0 ? static_cast<int>(std::floor(record.travelled / length_m)) : 0;
  for (const auto& [id, landmark] : map.landmarks()) {
    if (landmark.state != LandmarkState::kConfirmed) continue;
    const std::set<int> seen = Of(landmark);
    if (seen.size() < 2) continue;
    for (const int a : seen)
      for (const int b : seen)
        if (std::abs(a - b) > 1)  // an object ties what lies around it as well
          for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j) ties_.insert({a + i, b + j});
  }
}

std::set<int> Stretches::Of(const MapLandmark& landmark) const {
  std::set<int> stretches;
  for (const Sighting& sighting : landmark.sightings) {
    const auto at = of_frame_.find(sighting.frame);
    if (at != of_frame_.end()) stretches.insert(at->second);
  }
  return stretches;
}

bool Stretches::Tied(const MapLandmark& a, const MapLandmark& b) const {
  const std::set<int> of_a = Of(a), of_b = Of(b);
  return std::any_of(of_a.begin(), of_a.end(), [&](int i) {
    return std::any_of(of_b.begin(), of_b.end(), [&](int j) { return Tied(i, j); });
  });
}

bool Stretches::Tied(const FrameRecord& frame, const MapLandmark& landmark) const {
  const auto at = of_frame_.find(frame.frame);
  if (at == of_frame_.end()) return false;
  const std::set<int> seen = Of(landmark);
  return std::any_of(seen.begin(), seen.end(), [&](int j) { return Tied(at->second, j); });
}

}  // namespace sslcd
