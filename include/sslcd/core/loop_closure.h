// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

enum class LoopDecision {
  kNone,       ///< no pose fits better than chance
  kAmbiguous,  ///< a pose fits, but another one fits almost as well
  kAccepted,
};

/// "none", "ambiguous", "accepted".
const char* ToString(LoopDecision decision);

/// The decision about a loop with its reason.
struct LoopVerdict {
  LoopDecision decision = LoopDecision::kNone;
  std::string reason;       ///< why it was refused or accepted, for people
  double score = 0;         ///< log odds that the best pose is the right one [nats]
  double second_score = 0;  ///< the same for the second best pose
};

/// One attempt to close a loop, accepted or refused: a row of loops.csv.
struct LoopClosure {
  int id = 0;            ///< of the attempt: unique in a run, and stays when the decision changes
  int newest_frame = 0;  ///< newest frame of the attempt; the query frame may be earlier
  int query_frame = 0, match_frame = 0;  ///< frame numbers of the two cameras
  LoopDecision decision = LoopDecision::kNone;
  std::string reason;                  ///< why it was refused or accepted
  double score = 0, second_score = 0;  ///< log odds of the best and the second best pose [nats]
  /// that the best pose is right, by what the run knew at the attempt: 1 / (1 + exp(-score)). None
  /// if the score is no log odds: the printed finder's, or that of a host's matcher.
  std::optional<double> probability;
  Pose T_match_query;  ///< pose of the query camera in the match camera's frame
  /// covariance of the right perturbation T_match_query Exp(d), d = [translation, rotation]
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Identity();
  bool by_views = false;  ///< measured by aligned images instead of objects
  /// Of a camera less than `loop.lag_m` behind the newest one, whose own attempt is still to come:
  /// withdrawn when that is made, which may find the loop again. Never moves the trajectory. Early
  /// loops of one attempt are measured by the same objects as its own: they are not independent.
  bool early = false;
  double viewpoint_change_rad = 0;  ///< angle between the two headings, in [0, pi]
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;  ///< local, global
};

/// The loops that are not early.
std::vector<LoopClosure> WithoutEarly(std::vector<LoopClosure> loops);

/// A measured relative pose of two frames, given by index.
struct ViewTie {
  int from = 0, to = 0;
  RelativePose pose;  ///< T_from_to
};

}  // namespace sslcd
