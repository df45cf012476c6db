// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sslcd/core/loop_closure.h"
#include "sslcd/loop/options.h"

/// Every rule that accepts or refuses a loop, as pure functions: of one pair of finished maps
/// (DecideSingleLook), of a track of consecutive attempts (DecideTrack), of a solved pose graph
/// (ApplyGraphVerdict), and of the refined trajectory (IsWithdrawn).
namespace sslcd {

/// What one search has found, the evidence for the decision about its best pose.
struct SingleLook {
  std::vector<double> evidence;  ///< of the distinct poses, best first, at least one [nats]
  std::size_t matches = 0;       ///< number of matched objects of the best one
  /// log of the sum of exp(evidence) of the poses that were not refined [nats]
  double left_out = -std::numeric_limits<double>::infinity();
};

/// `mirror_evidence` computes the evidence of the mirror image of the local map; it is only called
/// if all other rules accept the pose.
LoopVerdict DecideSingleLook(const SingleLook& look, const std::function<double()>& mirror_evidence,
                             const SingleLookOptions& options);

/// The evidence for the decision about the best track of poses.
struct TrackEvidence {
  double evidence = 0;       ///< evidence of all its attempts against chance [nats]
  double margin = 0;         ///< log odds against all other tracks and "nowhere" [nats]
  double second_margin = 0;  ///< the same for the second best track, or for "nowhere"
  /// evidence of the objects of this attempt alone, at the track's pose [nats]
  double own_evidence = 0;
  /// log likelihood of the measured height against that of the trajectory, never positive [nats]
  double height = 0;
  double heading_sigma_rad = 0;  ///< standard deviation of the heading of the measured loop
  /// the loop joins two parts of the trajectory of which odometry says nothing
  bool joins = false;
  double lead = 0;  ///< log odds against chance and all other tracks [nats]
  /// log likelihood ratio of the looks of the matched objects: the same ones against others [nats]
  double appearance = 0;
};

/// Evidence of the objects of one attempt at its track's pose. `evidence`: of the fit, against
/// poses anywhere in the `searched` volume of the map [m^2 rad]; the track leaves far fewer of
/// them.
double EvidenceOnTrack(double evidence, double searched);

struct TrackVerdict {
  LoopVerdict loop;
  /// the attempt is a good measurement, which is accepted together with its track
  bool confirmed = false;
};
TrackVerdict DecideTrack(const TrackEvidence& track, const LoopAcceptanceOptions& options);

/// Applies the verdict of a pose graph solve to the loop. A later solve may change it.
void ApplyGraphVerdict(bool kept, LoopClosure& loop);

/// Whether the refined trajectory, with the query camera at `T_match_query` in the match camera's
/// frame, contradicts the measured loop.
bool IsWithdrawn(const LoopClosure& loop, const Pose& T_match_query,
                 const LoopAcceptanceOptions& options);

}  // namespace sslcd
