// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/closing/loop_options.h"

namespace sslcd {

OdometryNoise LongPathOdometryNoise() {
  OdometryNoise noise;
  noise.translation_floor_m = 0.02;
  noise.translation_walk = 0.05;
  noise.vertical_walk = 0.1;
  noise.rotation_floor_rad = 2e-3;
  noise.rotation_walk = 5e-3;
  noise.rotation_turn = 0.05;
  return noise;
}

void DescribeFields(FieldVisitor& visitor, LoopLayoutOptions& options) {
  visitor.Real("every_m", options.every_m, 0.1, 1000, "an attempt every so many metres of path");
  visitor.Real("local_m", options.local_m, 1, 10000,
               "the local map: objects seen on the last so many metres of path");
  visitor.Real("hindsight_m", options.hindsight_m, 0, 10000,
               "... when the whole run is looked at again at its end, after a loop was closed; 0: "
               "it is not");
  visitor.Real(
      "gap_m", options.gap_m, 0, 10000,
      "the global map: objects on passes that ended so many metres before the local map begins");
  visitor.Real("split_m", options.split_m, 0, 10000,
               "an object unseen for so much path is on another pass");
  visitor.Integer("min_sightings", options.min_sightings, 1, 1000,
                  "objects seen less often on a pass take no part");
}

void DescribeFields(FieldVisitor& visitor, LoopPriorOptions& options) {
  visitor.Real("drift_share", options.drift_share, 0, 1,
               "how far odometry may be off: position, share of the path");
  visitor.Real("drift_yaw", options.drift_yaw, 0, 1,
               "how far odometry may be off: yaw, rad per sqrt(m)");
  visitor.Real("surprise", options.surprise, 1e-9, 1, "share of loops for which these do not hold");
}

void DescribeFields(FieldVisitor& visitor, LoopViewOptions& options) {
  visitor.Flag(
      "enabled", options.enabled,
      "where there are stereo images, cameras of different passes are tied by the ground both see");
  visitor.Real("every_m", options.every_m, 0.1, 1000, "... every so many metres of path");
  visitor.Real("ahead_m", options.ahead_m, 0, 100,
               "the two look at one spot, so far ahead of each; for images, the tools choose it by "
               "the camera ...");
  visitor.Real("apart_m", options.apart_m, 0, 100, "... to this");
  visitor.Real("gap_m", options.gap_m, 1, 10000, "so much path lies between the two at least ...");
  visitor.Real("reach_m", options.reach_m, 0, 10000,
               "... and with closed loops as shortcuts so much at most, or what a better odometry "
               "takes ...");
  visitor.Real("guess_m", options.guess_m, 0, 10, "... to be this far off (loop.odometry)");
}

void DescribeFields(FieldVisitor& visitor, LoopOptions& options) {
  visitor.Flag("enabled", options.enabled, "close loops");
  visitor.Enum("finder", options.finder, {"tracks", "printed"},
               "how loops are found: by tracks of poses, or as the paper prints it");
  visitor.Nested("layout", options.layout, "what is compared with what (paper IV-A)");
  visitor.Nested("match", options.match, "layout matching (paper IV-B, IV-C)");
  visitor.Nested("tracks", options.tracks, "agreement of consecutive attempts");
  visitor.Nested("prior", options.prior, "what odometry says about a loop");
  visitor.Nested("acceptance", options.acceptance, "when a loop is accepted, and withdrawn");
  visitor.Nested("views", options.views, "ties between images of different passes");
  visitor.Real("lag_m", options.lag_m, 0, 1000,
               "the query camera stood so far back, amidst the matched objects");
  visitor.Real("sigma_m", options.sigma_m, 0, 100,
               "error of every loop on top of what its matches say");
  visitor.Real("sigma_rad", options.sigma_rad, 0, 3,
               "error of every loop on top of what its matches say");
  visitor.Real("fuse_m", options.fuse_m, 0, 100,
               "matched landmarks further apart than this do not become one");
  visitor.Nested("drift", options.drift, "drift of the matched objects (paper IV-D, Eq. 17)");
  visitor.Real("keyframe_m", options.keyframe_m, 0, 1000,
               "a vertex of the pose graph every so many metres of path");
  visitor.Nested("odometry", options.odometry, "how far the odometry between these is off");
  visitor.Flag("learn_odometry", options.learn_odometry,
               "at the end of a run its closed loops tell how far the odometry is off");
  visitor.Flag("robust", options.robust,
               "the pose graph may refuse accepted loops; false: it keeps all of them");
  visitor.Nested("graph", options.graph, "pose graph (paper IV-D, Eqs. 20, 21)");
  visitor.Integer("adjust_keyframes", options.adjust_keyframes, 0, 1000000,
                  "runs of so many keyframes at most have all cameras and objects adjusted after "
                  "each correction");
  visitor.Nested("paper", options.paper, "the matching of finder: printed");
}

}  // namespace sslcd
