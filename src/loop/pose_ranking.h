// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/coarse_poses.h"

namespace sslcd {

/// The most promising of many coarse poses, best first: aligns each with the objects of equal label
/// next to its own (closed form), and scores it by a short form of LayoutLikelihood,
///   max over sigma of  sum over matches (gain - 2 log sigma) - sum d^2 / (2 sigma^2)
///   + log Beta-binomials of the mapped and of the seen objects,
/// with one match per local object and the default LayoutLikelihoodOptions. `points` are the local
/// ones with the centre at the origin.
///
/// CoarseSearch::left_out takes this score for the evidence. Poses without a full score, the worse
/// ones, count like the median of those that have one.
CoarseSearch RankPoses(std::vector<CoarsePose> poses, const std::vector<LayoutPoint>& points,
                       const LayoutIndex& index, const PoseSearchOptions& options);

}  // namespace sslcd
