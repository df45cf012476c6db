// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "closing/loop_meter.h"
#include "two_passes.h"

namespace sslcd {

/// All trees of the second pass with those of the first one.
struct CommonTrees {
  PassLayout local;
  std::vector<std::pair<int, LandmarkId>> pairs;
  double sigma_m = 0.2;

  explicit CommonTrees(const TwoPasses& world)
      : local(PassLayouts(world.passes, world.state).Recent(world.end_m() - 70, 2)) {
    for (std::size_t i = 0; i < local.objects.size(); ++i)
      for (const auto& [early, late] : world.trees)
        if (local.objects[i].id == late.value) pairs.push_back({static_cast<int>(i), early});
  }
  CommonObjects objects() const { return {local, pairs, sigma_m, 200}; }

  /// Those that are seen, on average, between two points of the path.
  CommonTrees Between(double from_m, double to_m) const {
    CommonTrees some = *this;
    some.pairs.clear();
    for (const auto& pair : pairs)
      if (local.seen_m[pair.first] >= from_m && local.seen_m[pair.first] <= to_m)
        some.pairs.push_back(pair);
    return some;
  }
  /// Where on the path the first and the last of them are seen.
  std::pair<double, double> seen() const {
    std::vector<double> seen_m;
    for (const auto& pair : pairs) seen_m.push_back(local.seen_m[pair.first]);
    const auto [first, last] = std::minmax_element(seen_m.begin(), seen_m.end());
    return {*first, *last};
  }
};

/// Nothing is uncertain but what a test adds; roll and pitch are as given.
inline LoopOptions ExactOptions() {
  LoopOptions options;
  options.sigma_m = options.sigma_rad = 0;
  options.drift.six_dof = false;
  options.odometry = {};
  options.odometry.translation_floor_m = options.odometry.rotation_floor_rad = 1e-9;
  options.odometry.translation_walk = options.odometry.vertical_walk = 0;
  options.odometry.rotation_walk = options.odometry.rotation_turn = 0;
  return options;
}

}  // namespace sslcd
