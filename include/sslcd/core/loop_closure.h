// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/landmark.h"
#include "sslcd/core/pose.h"

namespace sslcd {

enum class LoopDecision {
  kNone,       ///< nothing found that could not be chance
  kAmbiguous,  ///< something fits, but something else fits nearly as well
  kAccepted,
};

/// "none", "ambiguous", "accepted".
const char* ToString(LoopDecision decision);

/// What is decided about a loop, and why.
struct LoopVerdict {
  LoopDecision decision = LoopDecision::kNone;
  std::string reason;       ///< why it was refused, or what speaks for it; for people
  double score = 0;         ///< log odds that the best pose is the right one [nats]
  double second_score = 0;  ///< the same of the second best
};

/// One attempt to close a loop, successful or not: a row of loops.csv.
struct LoopClosure {
  int newest_frame = 0;  ///< where it was looked for; the query frame may be an earlier one
  int query_frame = 0, match_frame = 0;
  LoopDecision decision = LoopDecision::kNone;
  std::string reason;  ///< why it was refused, or what settled it
  double score = 0, second_score = 0;
  Pose T_match_query;  ///< where the query camera stands in the match camera's frame
  /// Of the right perturbation T_match_query Exp(d), d = [translation, rotation].
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Identity();
  bool by_views = false;  ///< measured along a tie between aligned images, not by its objects
  double viewpoint_change_rad = 0;
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;  ///< local, global
};

/// Two cameras whose relative pose was measured, by the indices of their frames.
struct ViewTie {
  int from = 0, to = 0;
  RelativePose pose;  ///< T_from_to
};

}  // namespace sslcd
