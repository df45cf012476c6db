// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "eval/precision_recall.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Defines which keyframes revisit a place, so that a loop should be found for them.
struct RevisitOptions {
  /// path between two keyframes; a loop counts for the keyframes within this path of its query
  /// camera
  double spacing_m = 5.;
  double radius_m = 10.;  ///< a revisit has an old camera within this distance
  double old_m = 60.;     ///< a camera is old if it is at least this path behind
  /// a keyframe's objects are those seen within this path before and after it
  double around_m = 20.;
  int common = 5;  ///< smallest number of its objects that old cameras have seen
};

/// A keyframe at a place where the camera has been.
struct Revisit {
  int frame = 0, old_frame = 0;              ///< the keyframe, and the nearest old camera
  double at_m = 0;                           ///< path from the start to the keyframe
  double distance_m = 0, viewpoint_rad = 0;  ///< between the two cameras; viewpoint in [0, pi]
  int common = 0;                            ///< number of its objects that old cameras have seen
};

/// Finds the revisits from the true pose T_world_cam of each frame (KITTI camera axes) and the true
/// identity of each detection row (negative: a false alarm). Throws Error (kUsage) if a row has no
/// identity.
std::vector<Revisit> FindRevisits(const std::vector<Pose>& reference,
                                  const std::vector<Frame>& frames,
                                  const std::vector<int>& identities,
                                  const RevisitOptions& options = {});

/// The error of one loop, accepted or refused, against the true poses.
struct LoopOutcome {
  bool accepted = false;
  double score = 0;
  double at_m = 0;            ///< path from the start to the query camera
  double error_m = 0;         ///< of the query camera's horizontal position
  double error_rad = 0;       ///< of the query camera's rotation
  double viewpoint_rad = 0;   ///< true change of heading, in [0, pi]
  double height_error_m = 0;  ///< of the query camera's height, absolute
};
/// Compares each loop with the reference poses T_world_cam by frame number. Throws Error (kUsage)
/// if a frame has no reference pose.
std::vector<LoopOutcome> MeasureLoopErrors(const std::vector<LoopClosure>& loops,
                                           const std::vector<Pose>& reference);

/// Returns one answer per revisit, its best-scored correct loop (error below `true_m`) with the
/// revisit's viewpoint, and one answer per wrong loop. Correct loops elsewhere do not count. Thus
/// precision compares recognised places with wrong loops, and a second loop at the same place
/// changes nothing.
std::vector<ScoredAnswer> AnswersOf(const std::vector<Revisit>& revisits,
                                    const std::vector<LoopOutcome>& loops, double true_m,
                                    const RevisitOptions& options = {});

}  // namespace sslcd
