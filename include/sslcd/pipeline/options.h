// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/association/associate.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/fields.h"
#include "sslcd/loop/pose_tracks.h"
#include "sslcd/map/object_map.h"
#include "sslcd/optim/drift.h"
#include "sslcd/optim/object_ba.h"
#include "sslcd/optim/pose_graph_robust.h"
#include "sslcd/perception/colour.h"
#include "sslcd/perception/filter.h"

namespace sslcd {

/// The sliding window that runs with every keyframe.
struct WindowOptions {
  bool enabled = true;
  int keyframes = 8;           ///< cameras in the window
  double keyframe_m = 0.5;     ///< a new keyframe every so far ...
  double keyframe_rad = 0.05;  ///< ... or every such turn
  int min_sightings = 5;       ///< objects seen less often stay out ("more than 4 times", paper III-C)
};
void DescribeFields(FieldVisitor& visitor, WindowOptions& options);

/// The full-map optimisation at the end of a run (callable any time).
struct RefineOptions {
  bool enabled = true;
  int rounds = 2;             ///< optimise, associate anew, fuse, and again
  double keyframe_m = 1.;     ///< cameras of the optimisation: a keyframe every so far ...
  double keyframe_rad = 0.1;  ///< ... or every such turn; all other frames follow
  int min_sightings = 2;      ///< objects seen less often do not enter the final map
  double duplicate_m = 1.;    ///< landmarks of one label closer than this are one object
  double moved_m = 1.5;       ///< a landmark whose late sightings lie further than this from its early ones has moved
  double min_seen_share =
      0.4;  ///< a movable object seen in fewer of the frames it was in sight for is a chimera of passers-by
};
void DescribeFields(FieldVisitor& visitor, RefineOptions& options);

/// Keeping odometry upright that has no measurement of gravity.
struct LevelOptions {
  bool enabled = true;
  double max_slope_rad = 0.1;  ///< no ground is steeper than this on average ...
  double window_m = 200.;       ///< ... over so much path
};
void DescribeFields(FieldVisitor& visitor, LevelOptions& options);

/// Loop closure (paper IV).
struct LoopOptions {
  static LayoutMatchOptions DefaultMatch() {
    LayoutMatchOptions match;
    match.likelihood.wrong_height = 0.1;  // slopes and drifting tilt
    match.likelihood.leave_map = true;
    return match;
  }
  bool enabled = true;
  double every_m = 5.;                      ///< an attempt every so much path
  double local_m = 75.;                     ///< the local map: objects seen on the last so much path
  double gap_m = 10.;                       ///< the global map: objects on passes that ended so long ago
  double split_m = 30.;                     ///< unseen for so much path: another pass
  int min_sightings = 2;                    ///< objects seen less often on a pass take no part
  double min_margin = 10.;                   ///< log odds from which a pose is believed [nats]
  double drift_share = 0.02;                ///< how far odometry may be off: translation, share of the path ...
  double drift_yaw = 0.02;                  ///< ... and yaw [rad per sqrt(m)]
  double surprise = 0.05;                    ///< share of loops that these do not hold for
  double sigma_m = 0.15, sigma_rad = 0.02;  ///< of every loop edge, added to what the matches say
  double min_own_evidence = 2.;  ///< ... if its own objects, too, agree better than chance by this ...
  double max_heading_sigma_rad = 0.042;
  double max_apart_m = 20.;
  double probation_m = 2., probation_rad = 0.06;
  double place_m2_rad = 2.5;     ///< ... around the pose that its track predicts: about 2 m and 0.1 rad
  double lag_m = 25.;  ///< the query camera of an attempt stood so far back, with matched objects before and behind it
  double keyframe_m = 5.;
  double fuse_m = 3.;
  OdometryNoise odometry{0.02, 0.08, 2e-3, 5e-3, 0.05, 0.05};
  LayoutMatchOptions match = DefaultMatch();
  PoseTrackOptions tracks;
  DriftOptions drift{true, 0.03};
  RobustPoseGraphOptions graph;
};
void DescribeFields(FieldVisitor& visitor, LoopOptions& options);

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
