// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/bundle/options.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/map/options.h"

namespace SSLCD_EXPORT sslcd {

/// The full-map optimisation at the end of a run (callable any time).
struct RefineOptions {
  /// false: there is no second search for loops at the end of a run either
  bool enabled = true;
  int rounds = 2;  ///< rounds of: optimise, associate, fuse
  /// A frame is a keyframe of the optimisation after `keyframe_m` of path or a rotation of
  /// `keyframe_rad`. All other frames follow their neighbours.
  double keyframe_m = 1.;
  double keyframe_rad = 0.1;  ///< see `keyframe_m`
  int min_sightings = 2;      ///< objects with fewer sightings do not enter the final map
  double duplicate_m = 1.;    ///< landmarks of one label closer than this become one object
  /// a landmark whose late sightings are farther than this from its early ones has moved
  double moved_m = 1.5;
  /// a movable object that was seen in a smaller share of the frames in which it was visible counts
  /// as several passing objects
  double min_seen_share = 0.4;
  /// The optimised trajectory replaces the horizontal positions of the odometry, and its heights,
  /// only where it is nearer to the truth with this probability. 0: always.
  double least_probability = 0.99;
};
void DescribeFields(FieldVisitor& visitor, RefineOptions& options);

/// Gravity alignment of odometry without a measurement of gravity.
struct LevelOptions {
  bool enabled = true;
  double max_slope_rad = 0.1;  ///< steepest mean slope of the ground over `window_m` of path
  double window_m = 200.;      ///< length of path over which the slope is averaged
  /// standard deviation of the mean slope over `window_m`, for the optimisation of all cameras
  /// (SlopePrior); 0: the slope is not used
  double slope_rad = 0.05;
};
void DescribeFields(FieldVisitor& visitor, LevelOptions& options);

/// The options of optimising and fusing the whole map.
struct WholeMapOptions {
  DetectionNoise noise;
  MapOptions map;
  LevelOptions level;
  BaOptions ba;
  RefineOptions refine;
};

}  // namespace sslcd
