// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/loop/options.h"
#include "sslcd/odometry/options.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace SSLCD_EXPORT sslcd {

/// The local and the global map of an attempt to close a loop.
struct LoopLayoutOptions {
  double every_m = 5.;   ///< path from one attempt to the next
  double local_m = 75.;  ///< path whose objects make up the local map
  /// the same in the second search at the end of a run, where the narrow prior needs fewer objects;
  /// 0: no second search
  double hindsight_m = 60.;
  /// second searches per attempt while frames come, near the loops just found; 0: at the end only
  int look_back = 2;
  /// path between the end of the global map and the start of the local map
  double gap_m = 10.;
  /// an object that was out of sight for this length of path starts a new pass
  double split_m = 30.;
  int min_sightings = 2;  ///< objects with fewer sightings on a pass are ignored
};
void DescribeFields(FieldVisitor& visitor, LoopLayoutOptions& options);

/// The selection of camera pairs of different passes to align by their images (ViewAligner).
/// Odometry with closed loops as shortcuts gives the initial guess.
struct LoopViewOptions {
  bool enabled = true;
  double every_m = 2;  ///< smallest path from one tie to the next
  /// Two cameras see the same ground if the points at this distance ahead of them (see
  /// AlignmentRange) are at most `apart_m` apart.
  double ahead_m = 7;
  double apart_m = 6;  ///< largest distance of these points
  double gap_m = 30;   ///< smallest path between the two cameras
  /// Largest path between the two cameras, with closed loops as shortcuts. The limit is larger if
  /// the odometry (LoopOptions::odometry) needs more path to drift by `guess_m`.
  double reach_m = 75;
  double guess_m = 0.3;  ///< drift at which `reach_m` is enough
};
void DescribeFields(FieldVisitor& visitor, LoopViewOptions& options);

/// The odometry noise that loop closure assumes over metres to kilometres: five to ten times the
/// default OdometryNoise of a sliding window. Chosen on Victoria Park, the pole sequences and
/// HALV-sim, whose loops reveal such errors.
OdometryNoise LongPathOdometryNoise();

/// Loop closure, paper IV.
struct LoopOptions {
  /// How loops are found: by tracks of poses, or as printed in the paper. A host's PlaceMatcher
  /// replaces both.
  enum class Finder { kTracks, kPrinted };

  bool enabled = true;
  Finder finder = Finder::kTracks;
  LoopLayoutOptions layout;
  LayoutMatchOptions match;  ///< matching of the local with the global map
  PoseTrackOptions tracks;
  LoopAcceptanceOptions acceptance;
  LoopViewOptions views;
  /// path from the query camera to the newest one, so that matched objects lie on both sides of it
  double lag_m = 25.;
  /// Additional standard deviations per axis of every loop measured by objects.
  double sigma_m = 0.05;
  double sigma_rad = 0.007;  ///< the same for rotations
  /// largest distance of matched landmarks after the correction that are fused
  double fuse_m = 3.;
  DriftOptions drift;
  double keyframe_m = 5.;  ///< path from one vertex of the pose graph to the next
  /// Noise of the odometry edges of the pose graph. Larger than that of a good stereo rig, since
  /// loops reveal errors over kilometres that the sliding window does not see over metres.
  OdometryNoise odometry = LongPathOdometryNoise();
  /// at the end of a run, learn the errors of odometry from the closed loops
  /// (LearnOdometryByLoops)
  bool learn_odometry = true;
  /// false: the pose graph keeps every accepted loop, as in the paper (Eqs. 20, 21)
  bool robust = true;
  RobustPoseGraphOptions graph;
  /// up to this number of keyframes each correction is followed by an adjustment of all cameras and
  /// objects; longer runs do this only at the end. The cost grows with the run, and 150 to 500 give
  /// the same errors on Victoria Park
  int adjust_keyframes = 200;
  PaperMatchOptions paper;  ///< for Finder::kPrinted
};
void DescribeFields(FieldVisitor& visitor, LoopOptions& options);

}  // namespace sslcd
