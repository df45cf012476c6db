// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/closing/place_matcher.h"
#include "sslcd/core/fields.h"

namespace sslcd::baselines {

/// Place recognition by matched image points, e.g. SuperGlue's, scored as the paper does (V, Eq. S,
/// after Garg, Suenderhauf, Milford, "Semantic-geometric visual place recognition", IJRR 2019): the
/// mean confidence of the point matches of two images, 0 where there are fewer than five.
struct PointMatchOptions {
  int least_matches = 5;
  double accept_score = 0.5;  ///< not published: the paper sweeps it
};
void DescribeFields(FieldVisitor& visitor, PointMatchOptions& options);

/// `file`: a row for each point match, "query_frame match_frame confidence", frames by number,
/// confidence in [0, 1], any order, '#' begins a comment. The answer is the old frame with the
/// highest score (the earliest of equals), taken to be where the camera stands: point matches alone
/// fix no metric pose. Frames the global map does not know are passed over. Throws Error(kBadInput)
/// with file:line: unreadable, a wrong number of columns, frames that are negative or no whole
/// numbers, a match frame that is not before its query, a confidence outside [0, 1].
PlaceMatcher PointMatchMatcher(const std::string& file, const PointMatchOptions& options);

}  // namespace sslcd::baselines
