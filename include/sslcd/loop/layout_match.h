// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/core/layout.h"
#include "sslcd/loop/decision.h"
#include "sslcd/loop/layout_index.h"
#include "sslcd/loop/pose_search.h"

namespace sslcd {

/// How layouts are searched and scored.
struct LayoutMatchOptions {
  double max_pair_m = 50.;  ///< objects that are farther apart do not propose a pose together
  double reach_m = 2.;  ///< a local object is compared with the map's objects within this distance
  PoseSearchOptions search;
  LayoutLikelihoodOptions likelihood;
};
void DescribeFields(FieldVisitor& visitor, LayoutMatchOptions& options);

/// Where the local map lies in the global one, or why that cannot be told.
struct LayoutAnswer : LoopVerdict {
  /// Distinct poses, best first; may be empty. The answer is the first. Matches are indices into
  /// the local objects as given and into `index.objects()`.
  std::vector<PoseHypothesis> hypotheses;
};

/// Searches all poses of the local map in the global one and decides whether the best of them can
/// be trusted. Labels, positions and whatever else the objects know take part; there is no prior
/// pose. Objects whose position is not finite take no part. Before a pose is accepted, the mirror
/// image of the local map is searched as well: no camera ever sees it, so what it reaches is
/// chance. Deterministic; never throws for odd layouts, but says so in the verdict.
LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                          const LayoutMatchOptions& options,
                          const SingleLookOptions& decision = {});

}  // namespace sslcd
