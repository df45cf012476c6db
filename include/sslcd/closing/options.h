// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/fields.h"
#include "sslcd/loop/options.h"
#include "sslcd/odometry/options.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {

/// What is compared with what.
struct LoopLayoutOptions {
  double every_m = 5.;   ///< path from one attempt to the next
  double local_m = 75.;  ///< path whose objects make up the local map
  /// the same in the second search at the end of a run, where the pose is nearly known and fewer
  /// objects are enough; 0: there is no second search
  double hindsight_m = 60.;
  /// path between the end of the global map's passes and the start of the local map
  double gap_m = 10.;
  /// an object that was out of sight for this length of path is on another pass when it comes back
  double split_m = 30.;
  int min_sightings = 2;  ///< objects with fewer sightings on a pass take no part
};
void DescribeFields(FieldVisitor& visitor, LoopLayoutOptions& options);

/// How far odometry may be off before any object is looked at. Closed loops count as shortcuts:
/// after the first one the trajectory is nearly right, and the prior is narrow.
struct LoopPriorOptions {
  double drift_share = 0.02;  ///< standard deviation of the position, share of the path
  double drift_yaw = 0.02;    ///< random walk of the yaw [rad per sqrt(m)]
  double surprise = 1e-6;     ///< share of loops for which the two above do not hold
};
void DescribeFields(FieldVisitor& visitor, LoopPriorOptions& options);

/// Where cameras of different passes are tied to each other by their images (ViewAligner): where
/// odometry, with closed loops as shortcuts, says where to look.
struct LoopViewOptions {
  bool enabled = true;
  double every_m = 2;  ///< least path from one tie to the next
  /// Two cameras look at one spot on the ground if the points this far ahead of each (see
  /// AlignmentRange) are at most `apart_m` apart.
  double ahead_m = 7;
  double apart_m = 6;
  double gap_m = 30;  ///< least path between the two cameras
  /// Most path between the two cameras, closed loops counted as shortcuts. Where odometry
  /// (LoopOptions::odometry) needs more path than that to be off by `guess_m`, that path counts.
  double reach_m = 75;
  double guess_m = 0.3;
};
void DescribeFields(FieldVisitor& visitor, LoopViewOptions& options);

/// What loop closure expects of odometry, from some metres to kilometres: five to ten times what
/// OdometryNoise expects over the metres of a sliding window. Chosen on Victoria Park, the pole
/// sequences and HALV-sim, whose loops reveal such errors.
OdometryNoise LongPathOdometryNoise();

/// Loop closure, paper IV.
struct LoopOptions {
  /// How loops are found: by tracks of poses, or as the paper prints it. A host's PlaceMatcher
  /// replaces either.
  enum class Finder { kTracks, kPrinted };

  bool enabled = true;
  Finder finder = Finder::kTracks;
  LoopLayoutOptions layout;
  LayoutMatchOptions match;
  PoseTrackOptions tracks;
  LoopPriorOptions prior;
  LoopAcceptanceOptions acceptance;
  LoopViewOptions views;
  /// path from the query camera to the newest one: matched objects lie before and behind it
  double lag_m = 25.;
  /// Errors of every loop measured by objects that its matches do not show, per axis.
  double sigma_m = 0.15;
  double sigma_rad = 0.02;
  /// matched landmarks that are farther apart than this after the correction do not become one
  double fuse_m = 3.;
  DriftOptions drift;
  double keyframe_m = 5.;  ///< path from one vertex of the pose graph to the next
  /// Of the edges between them. Coarser than the odometry of a good stereo rig: what loops reveal
  /// over kilometres is more than what the sliding window has to expect over metres.
  OdometryNoise odometry = LongPathOdometryNoise();
  /// at the end of a run, learn the errors of odometry from the closed loops
  /// (LearnOdometryFactors)
  bool learn_odometry = true;
  /// false: every accepted loop stays an edge, as in the paper (Eqs. 20, 21)
  bool robust = true;
  RobustPoseGraphOptions graph;
  /// up to this number of keyframes all cameras and objects are adjusted after each correction; in
  /// longer runs only at the end
  int adjust_keyframes = 500;
  PaperMatchOptions paper;  ///< of Finder::kPrinted
};
void DescribeFields(FieldVisitor& visitor, LoopOptions& options);

}  // namespace sslcd
