// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "eval/precision_recall.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// When a keyframe counts as one that a loop should be found for.
struct RevisitOptions {
  /// path between two keyframes; a loop counts for keyframes this near to its query camera
  double spacing_m = 5.;
  double radius_m = 10.;  ///< an old camera stood this near ...
  double old_m = 60.;     ///< ... and is older by at least this path
  /// of the objects seen within this path before and after the keyframe ...
  double around_m = 20.;
  int common = 5;  ///< ... so many were seen by old cameras
};

/// A keyframe at a place where the camera has been.
struct Revisit {
  int frame = 0, old_frame = 0;              ///< the keyframe, and the nearest old camera
  double at_m = 0;                           ///< its place on the path
  double distance_m = 0, viewpoint_rad = 0;  ///< between the two cameras; viewpoint in [0, pi]
  int common = 0;
};

/// By true poses T_world_cam of each frame (KITTI camera axes) and true identities of each
/// detection row (negative: a false alarm). Throws Error (kUsage) where a row has no identity.
std::vector<Revisit> FindRevisits(const std::vector<Pose>& reference,
                                  const std::vector<Frame>& frames,
                                  const std::vector<int>& identities,
                                  const RevisitOptions& options = {});

/// What a loop, accepted or not, says and what is true.
struct LoopOutcome {
  bool accepted = false;
  double score = 0;
  double at_m = 0;            ///< its query camera's place on the path
  double error_m = 0;         ///< of the query camera's horizontal position
  double error_rad = 0;       ///< of its rotation
  double viewpoint_rad = 0;   ///< true change of heading, in [0, pi]
  double height_error_m = 0;  ///< of the query camera's height, absolute
};
/// Throws Error (kUsage) on a frame without a reference pose.
std::vector<LoopOutcome> JudgeLoops(const std::vector<LoopClosure>& loops,
                                    const std::vector<Pose>& reference);

/// For each revisit the surest loop near it that is right (error below `true_m`), as an answer with
/// the revisit's viewpoint; and every wrong loop, with its own. What is right elsewhere counts
/// neither way. So precision is that of places recognised against wrong loops, and nothing is
/// gained by saying the same thing twice.
std::vector<ScoredAnswer> AnswersOf(const std::vector<Revisit>& revisits,
                                    const std::vector<LoopOutcome>& loops, double true_m,
                                    const RevisitOptions& options = {});

}  // namespace sslcd
