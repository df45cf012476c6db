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
  double accept_score = 0.5;  ///< not published; the paper varies it
};
void DescribeFields(FieldVisitor& visitor, PointMatchOptions& options);

/// `file` has a row "query_frame match_frame confidence" per point match, in any order, with frame
/// numbers and a confidence in [0, 1]; '#' starts a comment. The answer is the old frame with the
/// highest score (the earliest on a tie) with an identity pose, since point matches alone determine
/// no metric pose. Ignores frames that the global map lacks. Throws Error(kBadInput) with file:line
/// for an unreadable file, a wrong number of columns, malformed or negative frame numbers, a match
/// frame that is not before its query, and a confidence outside [0, 1].
PlaceMatcher PointMatchMatcher(const std::string& file, const PointMatchOptions& options);

}  // namespace sslcd::baselines
