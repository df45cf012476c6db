// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/core/layout.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/loop/layout_index.h"
#include "sslcd/loop/pose_search.h"

namespace sslcd {

/// When is the best pose believed? The likelihoods are calibrated: if the place is in the map at
/// all, the log odds are about those of being right. Where it need not be in the map, ask for more
/// (docs/results.md has the curve): a score of 5 still refuses what only looks alike 9 times of 10,
/// of 10 99 times of 100.
struct DecisionOptions {
  double min_margin = 0.75;  ///< log odds of the best pose against all others found [nats]
  /// evidence that chance reaches: competes with the poses found [nats]
  double min_evidence = -10.;
  /// a mirror image of the local map that fits better by this refutes the fit [nats]
  double mirror_gain = 5.;
};
void DescribeFields(FieldVisitor& visitor, DecisionOptions& options);

/// Everything that layout matching can be told.
struct LayoutMatchOptions {
  double max_pair_m = 50.;  ///< objects further apart than this propose no pose together
  double reach_m = 2.;      ///< a local object is compared with what the map has within this
  PoseSearchOptions search;
  LayoutLikelihoodOptions likelihood;
  DecisionOptions decision;
};
void DescribeFields(FieldVisitor& visitor, LayoutMatchOptions& options);

/// Where the local map lies in the global one - or why nobody can know.
struct LayoutAnswer {
  LoopDecision decision = LoopDecision::kNone;
  std::string reason;       ///< why it was refused, or what speaks for it; for people
  double score = 0;         ///< log odds that the best pose is the right one [nats]
  double second_score = 0;  ///< the same of the second best
  /// Distinct poses, best first; may be empty. The answer is the first. Matches are indices into
  /// the local objects as given and into `index.objects()`.
  std::vector<PoseHypothesis> hypotheses;
};

/// Searches all poses of the local map in the global one and decides whether the best of them can
/// be trusted. Labels, positions and whatever else the objects know take part; there is no prior
/// pose. Objects whose position is not finite take no part. Before a pose is accepted, the mirror
/// image of the local map is searched as well: no camera ever sees it, so what it reaches is
/// chance. Deterministic; never throws for odd layouts, but says so in `reason`.
LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                          const LayoutMatchOptions& options);

}  // namespace sslcd
