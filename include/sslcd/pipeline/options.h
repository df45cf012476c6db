// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/association/associate.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/fields.h"
#include "sslcd/map/object_map.h"
#include "sslcd/optim/object_ba.h"
#include "sslcd/perception/colour.h"
#include "sslcd/perception/filter.h"
#include "sslcd/pipeline/loop_options.h"

namespace sslcd {

/// The sliding window that runs with every keyframe.
struct WindowOptions {
  bool enabled = true;
  int keyframes = 8;           ///< cameras in the window
  double keyframe_m = 0.5;     ///< a new keyframe every so far ...
  double keyframe_rad = 0.05;  ///< ... or every such turn
  /// objects seen less often stay out ("more than 4 times", paper III-C)
  int min_sightings = 5;
};
void DescribeFields(FieldVisitor& visitor, WindowOptions& options);

/// The full-map optimisation at the end of a run (callable any time).
struct RefineOptions {
  bool enabled = true;        ///< false: loops are not looked for once more, with hindsight, either
  int rounds = 2;             ///< optimise, associate anew, fuse, and again
  double keyframe_m = 1.;     ///< cameras of the optimisation: a keyframe every so far ...
  double keyframe_rad = 0.1;  ///< ... or every such turn; all other frames follow
  int min_sightings = 2;      ///< objects seen less often do not enter the final map
  double duplicate_m = 1.;    ///< landmarks of one label closer than this are one object
  /// a landmark whose late sightings lie further than this from its early ones has moved
  double moved_m = 1.5;
  double min_seen_share = 0.4;  ///< a movable object seen in fewer of the frames it was in sight
                                ///< for is a chimera of passers-by
};
void DescribeFields(FieldVisitor& visitor, RefineOptions& options);

/// Keeping odometry upright that has no measurement of gravity.
struct LevelOptions {
  bool enabled = true;
  double max_slope_rad = 0.1;  ///< no ground is steeper than this on average ...
  double window_m = 200.;      ///< ... over so much path
  /// How steep it usually is over so much path, a standard deviation, for the adjustments of all
  /// cameras: SlopePrior.
  double slope_rad = 0.05;
};
void DescribeFields(FieldVisitor& visitor, LevelOptions& options);

/// Everything that can be configured.
struct Options {
  enum class Mode { kRobust, kPaper };
  Mode mode = Mode::kRobust;
  DetectionFilterOptions filter;
  ColourOptions colour;
  DetectionNoise noise;
  AssociationOptions association;
  MapOptions map;
  LevelOptions level;
  WindowOptions window;
  BaOptions ba;
  LoopOptions loop;
  RefineOptions refine;
};
void DescribeFields(FieldVisitor& visitor, Options& options);

/// The equations as printed (`mode: paper`) or the system as its users need it (`mode: robust`).
Options DefaultOptions(Options::Mode mode);

}  // namespace sslcd
