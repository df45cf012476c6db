// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/core/layout.h"
#include "sslcd/loop/layout_index.h"
#include "sslcd/loop/layout_likelihood.h"

namespace sslcd {

/// Where could the local map lie in the global one, without any prior? Two objects fix a pose (yaw
/// and shift), so every pair of local objects is laid on every pair of global objects of the same
/// labels and distance; each pose found is scored by how many other objects fall on one another
/// (one look into a grid each), and the best ones are refined and weighed by `LayoutLikelihood`. In
/// large maps, triangles of neighbours take the place of the pairs (`LayoutIndex`).
struct PoseSearchOptions {
  int refine = 100;     ///< coarse poses that are refined, the best ones
  int min_matches = 4;  ///< objects that have to fit; three fit somewhere in any map
  /// no key: two poses are the same if they take the local map's centre to within `distinct_m` of
  /// each other and differ in yaw by less than `distinct_rad`. Set by hand, about the accuracy of a
  /// coarse pose.
  double distinct_m = 2.;
  double distinct_rad = 0.1;
};
void DescribeFields(FieldVisitor& visitor, PoseSearchOptions& options);

struct PoseHypothesis {
  YawShift pose;  ///< local to global
  LayoutFit fit;  ///< how well the layouts agree under it
};

/// Distinct poses of `likelihood.local()` in `likelihood.index()`, best first. O(pairs of equal
/// distance), in large maps O(triangles of equal sides).
std::vector<PoseHypothesis> SearchPoses(const LayoutLikelihood& likelihood,
                                        const PoseSearchOptions& options);

}  // namespace sslcd
