// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "loop/layout_index.h"
#include "loop/layout_likelihood.h"
#include "sslcd/core/layout.h"
#include "sslcd/loop/layout_match.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// Where could the local map lie in the global one, without any prior? Two objects fix a pose (yaw
/// and shift), so every pair of local objects is laid on every pair of global objects of the same
/// labels and distance; each pose found is scored by how many other objects fall on one another
/// (one look into a grid each), and the best ones are refined and weighed by `LayoutLikelihood`. In
/// large maps, triangles of neighbours take the place of the pairs (`LayoutIndex`).
///
/// Distinct poses of `likelihood.local()` in `likelihood.index()`, best first. O(pairs of equal
/// distance), in large maps O(triangles of equal sides).
std::vector<PoseHypothesis> SearchPoses(const LayoutLikelihood& likelihood,
                                        const PoseSearchOptions& options);

}  // namespace sslcd
