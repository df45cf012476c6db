// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/loop_closure.h"
#include "sslcd/loop/options.h"

/// Every rule that accepts or refuses a loop, as pure functions: of one pair of finished maps
/// (DecideSingleLook), of a track of consecutive attempts (DecideTrack), of a solved pose graph
/// (ApplyGraphVerdict), and of the refined trajectory (IsWithdrawn).
namespace sslcd {

/// `evidence`: of the distinct poses found, best first, at least one [nats]. `matches`: how many
/// objects agree under the best. `mirror_evidence`: what the mirror image of the local map reaches;
/// asked only where everything else speaks for the pose.
LoopVerdict DecideSingleLook(const std::vector<double>& evidence, std::size_t matches,
                             const std::function<double()>& mirror_evidence,
                             const SingleLookOptions& options);

/// What is known about the best track of poses when it is decided about.
struct TrackEvidence {
  double evidence = 0;           ///< of all its attempts, against chance [nats]
  double margin = 0;             ///< log odds against all other tracks and "nowhere" [nats]
  double second_margin = 0;      ///< the same of the second best track
  double own_evidence = 0;       ///< of the objects of this attempt alone, at the track's pose
  double heading_sigma_rad = 0;  ///< of the measured loop
  double apart_m = 0;            ///< between query and match camera
};

struct TrackVerdict {
  LoopVerdict loop;
  /// This attempt is a good measurement; it is accepted as soon as its track is.
  bool confirmed = false;
};
TrackVerdict DecideTrack(const TrackEvidence& track, const LoopAcceptanceOptions& options);

/// A solve of the pose graph has kept the loop or has refused it; either may change later.
void ApplyGraphVerdict(bool kept, LoopClosure& loop);

/// Does the refined trajectory, with the query camera at `T_match_query` in the match camera's
/// frame, contradict the loop as it was measured?
bool IsWithdrawn(const LoopClosure& loop, const Pose& T_match_query,
                 const LoopAcceptanceOptions& options);

}  // namespace sslcd
