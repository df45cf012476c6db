// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "loop/layout_index.h"
#include "loop/layout_likelihood.h"
#include "sslcd/core/layout.h"
#include "sslcd/loop/layout_match.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// Options of the search for poses of the local map in the global one without a prior. Two objects
/// determine a pose (yaw and shift), so every pair of local objects is aligned with every pair of
/// global objects of the same labels and distance. The score of a coarse pose is the number of
/// other objects that coincide, with one grid lookup each. `LayoutLikelihood` refines and scores
/// the best ones. Large maps are searched everywhere at the headings of their rows
/// (`LargeMapPoses`).
///
/// Distinct poses of `likelihood.local()` in `likelihood.index()`, best first. O(pairs of equal
/// distance), in large maps O(area of the map).
///
/// `prior`: orders poses before objects are compared. Where a map repeats itself, the best coarse
/// poses alone do not hold the poses next to the prior; with it the most probable ones of ten times
/// as many coarse poses are refined, too.
std::vector<PoseHypothesis> SearchPoses(const LayoutLikelihood& likelihood,
                                        const PoseSearchOptions& options,
                                        const std::function<double(const YawShift&)>& prior = {});

/// SearchPoses without a prior, and what it has not refined.
struct SearchedPoses {
  std::vector<PoseHypothesis> found;  ///< distinct, best first
  std::size_t looked_at = 0;          ///< number of coarse poses
  /// log of the sum of exp(evidence) of the coarse poses that were not refined, estimated from
  /// their scores (CoarseSearch::left_out); known in large maps only [nats]
  double left_out = -std::numeric_limits<double>::infinity();
};
SearchedPoses SearchAllPoses(const LayoutLikelihood& likelihood, const PoseSearchOptions& options);

}  // namespace sslcd
