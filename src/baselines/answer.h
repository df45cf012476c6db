// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sslcd/closing/place_matcher.h"
#include "sslcd/core/layout.h"

namespace sslcd::baselines {

/// Index of a local object, index of the global object taken for it.
using ObjectPairs = std::vector<std::pair<int, int>>;

/// What a baseline says about two layouts.
struct Answer {
  ObjectPairs matches;    ///< those that agree with the pose, one to one, by ascending local object
  YawShift pose;          ///< local to global
  double score = 0;       ///< higher is surer; what it means differs between methods
  bool accepted = false;  ///< by the method's own rule
};

/// None: no pose at all.
using LayoutMatcher = std::function<std::optional<Answer>(const std::vector<LayoutObject>& local,
                                                          const std::vector<LayoutObject>& global)>;

/// The hook by which a baseline takes the place of sslcd's own matching.
PlaceMatcher AsPlaceMatcher(LayoutMatcher matcher);

}  // namespace sslcd::baselines
