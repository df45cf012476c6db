// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/core/loop_closure.h"

/// Every rule that accepts or refuses a loop, as pure functions: of one pair of finished maps
/// (DecideSingleLook), of a track of consecutive attempts (DecideTrack), of a solved pose graph
/// (ApplyGraphVerdict), and of the refined trajectory (IsWithdrawn).
namespace sslcd {

/// What is decided about a loop, and why.
struct LoopVerdict {
  LoopDecision decision = LoopDecision::kNone;
  std::string reason;       ///< why it was refused, or what speaks for it; for people
  double score = 0;         ///< log odds that the best pose is the right one [nats]
  double second_score = 0;  ///< the same of the second best
};

/// When the best pose of a single look is accepted. The likelihoods are calibrated: if the place is
/// in the map at all, the log odds are about those of being right. Where it need not be in the map,
/// ask for more: a score of 5 still refuses what only looks alike 9 times of 10, of 10 99 times of
/// 100. Chosen on object-pairs of seeds other than 7 (docs/results.md).
struct SingleLookOptions {
  double min_margin = 0.75;    ///< log odds of the best pose against all others found [nats]
  double min_evidence = -10.;  ///< evidence that chance reaches: competes with the poses [nats]
  double mirror_gain = 5.;     ///< a mirror image that fits better by this refutes the fit [nats]
};
void DescribeFields(FieldVisitor& visitor, SingleLookOptions& options);

/// `evidence`: of the distinct poses found, best first, at least one [nats]. `matches`: how many
/// objects agree under the best. `mirror_evidence`: what the mirror image of the local map reaches;
/// asked only where everything else speaks for the pose.
LoopVerdict DecideSingleLook(const std::vector<double>& evidence, std::size_t matches,
                             const std::function<double()>& mirror_evidence,
                             const SingleLookOptions& options);

/// When the loop of a track is accepted, and when an accepted one is withdrawn. Chosen on HALV-sim
/// (seeds 1 to 10), Victoria Park and the pole sequences; the same for all.
struct LoopAcceptanceOptions {
  /// log odds of its track against all others and against "nowhere" [nats]
  double min_margin = 13.;
  double max_heading_sigma_rad = 0.042;  ///< standard deviation of the measured heading, at most
  double max_apart_m = 30.;              ///< distance between the two cameras, at most
  /// withdrawn where the refined trajectory differs by this or more ...
  double withdraw_m = 2.;
  double withdraw_rad = 0.06;  ///< ... or turns by this or more
};
void DescribeFields(FieldVisitor& visitor, LoopAcceptanceOptions& options);

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
