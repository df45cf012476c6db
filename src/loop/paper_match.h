// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/layout.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// An object of the local map and the one of the global map taken for it.
struct ObjectMatch {
  int local = 0, global = 0;  ///< indices into the lists given to PaperMatch
  double layout_difference = 0;
  double similarity = 0;
};

/// Paper IV-A to IV-C as printed: the graphs of both maps, candidate pairs by spatial layout, of
/// which each local object keeps the most similar one (the first one of equals), if it is similar
/// enough. Several local objects may get the same global one: the paper does not forbid it. Sorted
/// by `local`. None with fewer than `min_matches` matches. Objects whose position is not finite
/// take no part. O(local x global).
///
/// Kept for comparison (mode: paper); `config` aside, nothing here knows when to refuse.
std::optional<std::vector<ObjectMatch>> PaperMatch(const std::vector<LayoutObject>& local,
                                                   const std::vector<LayoutObject>& global,
                                                   const PaperMatchOptions& options);

}  // namespace sslcd
