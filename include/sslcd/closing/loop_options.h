// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/fields.h"
#include "sslcd/loop/decision.h"
#include "sslcd/loop/layout_match.h"
#include "sslcd/loop/paper_match.h"
#include "sslcd/loop/pose_tracks.h"
#include "sslcd/optim/drift.h"
#include "sslcd/optim/odometry_noise.h"
#include "sslcd/optim/pose_graph_robust.h"

namespace sslcd {

/// What is compared with what.
struct LoopLayoutOptions {
  double every_m = 5.;   ///< an attempt every so much path
  double local_m = 75.;  ///< the local map: objects seen on the last so much path
  /// ... when the whole run is looked at again: the pose is nearly known, fewer objects do
  double hindsight_m = 60.;
  /// the global map: objects on passes that ended so long before the local map begins
  double gap_m = 10.;
  /// an object unseen for so much path is on another pass when it comes back
  double split_m = 30.;
  int min_sightings = 2;  ///< objects seen less often on a pass take no part
};
void DescribeFields(FieldVisitor& visitor, LoopLayoutOptions& options);

/// How far odometry may be off before any object is looked at. Closed loops count as shortcuts:
/// after the first one the camera is known to be near where it believes to be.
struct LoopPriorOptions {
  double drift_share = 0.02;  ///< position error per path
  double drift_yaw = 0.02;    ///< yaw error [rad per sqrt(m)]
  double surprise = 1e-6;     ///< share of loops for which these do not hold
};
void DescribeFields(FieldVisitor& visitor, LoopPriorOptions& options);

/// Where cameras of different passes are tied to each other by their images (ViewAligner): where
/// odometry, with closed loops as shortcuts, says where to look.
struct LoopViewOptions {
  bool enabled = true;
  double every_m = 2;  ///< a tie every so much path at most
  /// the two look at one spot on the ground, so far ahead of each (SpotAhead) ...
  double ahead_m = 7;
  double apart_m = 6;  ///< ... to this
  double gap_m = 30;   ///< so much path lies between them at least
  /// ... and with closed loops as shortcuts so much at most, or what a better odometry takes ...
  double reach_m = 75;
  double guess_m = 0.3;  ///< ... to be this far off (LoopOptions::odometry)
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
  /// the query camera stood so far back: with matched objects before and behind it
  double lag_m = 25.;
  double sigma_m = 0.15;  ///< of every loop measured by objects, on top of what its matches say
  double sigma_rad = 0.02;
  /// matched landmarks that are still further apart than this do not become one
  double fuse_m = 3.;
  DriftOptions drift;
  double keyframe_m = 5.;  ///< vertices of the pose graph: a keyframe every so much path
  /// Of the edges between them. Coarser than the odometry of a good stereo rig: what loops reveal
  /// over kilometres is more than what the sliding window has to expect over metres.
  OdometryNoise odometry = LongPathOdometryNoise();
  /// how far it is off, at the end, from the closed loops (LearnOdometryFactors)
  bool learn_odometry = true;
  /// false: every accepted loop stays an edge, as in the paper (Eqs. 20, 21)
  bool robust = true;
  RobustPoseGraphOptions graph;
  /// a run of so many keyframes at most has all cameras and objects adjusted after a loop has moved
  /// them; a longer one not before the end
  int adjust_keyframes = 500;
  PaperMatchOptions paper;  ///< of Finder::kPrinted
};
void DescribeFields(FieldVisitor& visitor, LoopOptions& options);

}  // namespace sslcd
