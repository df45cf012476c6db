// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// The paper's two-stage graph matching. It prints none of these values; K and delta are those of
/// the layout test that its authors published, mu weighs both kinds of properties alike, and tau
/// lets an object pass that is half a metre off in size and one metre in position, with vectors of
/// cosine 0.75.
struct PaperMatchOptions {
  int neighbours = 2;              ///< K of IV-A
  double layout_difference = 0.2;  ///< delta of IV-B: candidates have d_f below it
  /// balance of IV-C: 1 geometry only, 0 colour and embedding only
  double mu = 0.5;
  double similarity = 0.7;  ///< tau of IV-C: matches have s_l of at least this, of at most 2
  int min_matches = 2;      ///< "multiple matches" of IV-D
};
void DescribeFields(FieldVisitor& visitor, PaperMatchOptions& options);

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
