// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/detection_noise.h"
#include "sslcd/core/fields.h"
#include "sslcd/map/object_map.h"
#include "sslcd/optim/object_ba.h"

namespace sslcd {

/// The full-map optimisation at the end of a run (callable any time).
struct RefineOptions {
  /// false: there is no second search for loops at the end of a run either
  bool enabled = true;
  int rounds = 2;             ///< optimise, associate again, fuse, and repeat
  double keyframe_m = 1.;     ///< cameras of the optimisation: a keyframe after this much path ...
  double keyframe_rad = 0.1;  ///< ... or after this turn; all other frames follow
  int min_sightings = 2;      ///< objects seen less often do not enter the final map
  double duplicate_m = 1.;    ///< landmarks of one label closer than this are one object
  /// a landmark whose late sightings lie further than this from its early ones has moved
  double moved_m = 1.5;
  /// a movable object seen in a smaller share of the frames it was in sight for is a chimera of
  /// passers-by
  double min_seen_share = 0.4;
};
void DescribeFields(FieldVisitor& visitor, RefineOptions& options);

/// Keeping odometry upright that has no measurement of gravity.
struct LevelOptions {
  bool enabled = true;
  double max_slope_rad = 0.1;  ///< the steepest mean slope of the ground ...
  double window_m = 200.;      ///< ... over a path of this length
  /// standard deviation of that mean slope, for the optimisation of all cameras: SlopePrior
  double slope_rad = 0.05;
};
void DescribeFields(FieldVisitor& visitor, LevelOptions& options);

/// What optimisation and fusion of the whole map read.
struct WholeMapOptions {
  DetectionNoise noise;
  MapOptions map;
  LevelOptions level;
  BaOptions ba;
  RefineOptions refine;
};

}  // namespace sslcd
