// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/layout.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// A matched pair of a local and a global object.
struct ObjectMatch {
  int local = 0, global = 0;  ///< indices into the lists given to PaperMatch
  double layout_difference = 0;
  double similarity = 0;
};

/// Paper IV-A to IV-C as printed: builds the graphs of both maps, selects candidate pairs by
/// spatial layout, and keeps for each local object the most similar candidate (the first one on a
/// tie), if it is similar enough. Several local objects may match the same global one, which the
/// paper does not exclude. Sorted by `local`. None with fewer than `min_matches` matches. Ignores
/// objects whose position is not finite. O(local x global).
/// For comparison (mode: paper). It has no rule that refuses a wrong match.
std::optional<std::vector<ObjectMatch>> PaperMatch(const std::vector<LayoutObject>& local,
                                                   const std::vector<LayoutObject>& global,
                                                   const PaperMatchOptions& options);

}  // namespace sslcd
