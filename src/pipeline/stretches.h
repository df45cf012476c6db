// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Which stretches of the path speak of one place. Neighbouring stretches do, and stretches that
/// share a confirmed object (because a loop closure has fused it). Elsewhere the drift between two
/// visits may put anything anywhere: standing in one place is no evidence there.
class Stretches {
 public:
  /// Stretches of `length_m` of odometry path; <= 0: everything is one.
  Stretches(const ObjectMap& map, const std::vector<FrameRecord>& frames, double length_m);

  bool Tied(const MapLandmark& a, const MapLandmark& b) const;
  bool Tied(const FrameRecord& frame, const MapLandmark& landmark) const;

 private:
  std::set<int> Of(const MapLandmark& landmark) const;
  bool Tied(int a, int b) const {
    return a - b <= 1 && b - a <= 1 ? true : ties_.count({a, b}) > 0;
  }

  std::map<int, int> of_frame_;
  std::set<std::pair<int, int>> ties_;
};

}  // namespace sslcd
