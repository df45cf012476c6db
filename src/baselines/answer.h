// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sslcd/closing/place_matcher.h"
#include "sslcd/core/layout.h"

namespace sslcd::baselines {

/// Pairs of the index of a local object and the index of its match in the global map.
using ObjectPairs = std::vector<std::pair<int, int>>;

/// The answer of a baseline for two layouts.
struct Answer {
  ObjectPairs matches;    ///< inliers of the pose, one to one, sorted by local object
  YawShift pose;          ///< T_global_local
  double score = 0;       ///< higher is more certain; its meaning differs between methods
  bool accepted = false;  ///< the decision of the method
};

/// None: no pose.
using LayoutMatcher = std::function<std::optional<Answer>(const std::vector<LayoutObject>& local,
                                                          const std::vector<LayoutObject>& global)>;

/// Makes a PlaceMatcher of a baseline, which replaces sslcd's own matching.
PlaceMatcher AsPlaceMatcher(LayoutMatcher matcher);

}  // namespace sslcd::baselines
