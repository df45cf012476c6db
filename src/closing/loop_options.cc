// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/closing/options.h"

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
  visitor.Everyday("smaller: loops are found sooner, and slower runs")
      .Real("every_m", options.every_m, 0.1, 1000, "path from one search for a loop to the next");
  visitor.Everyday("larger: more certain loops; too large: odometry bends the local map")
      .Real("local_m", options.local_m, 1, 10000,
            "the local map holds the objects seen on this length of path");
  visitor.Everyday("0: a run ends sooner, without the loops that a second search finds")
      .Real(
          "hindsight_m", options.hindsight_m, 0, 10000,
          "length of the local map in the second search at the end of a run; 0: no second search");
  visitor.Everyday("2: a host has most loops before the end, for twice the time of loop detection")
      .Integer("look_back", options.look_back, 0, 1000,
               "second searches per search while frames come, near the loops just found; 0: at the "
               "end only");
  visitor.Everyday("larger: loops between nearby parts of the path are not searched for")
      .Real("gap_m", options.gap_m, 0, 10000,
            "the global map holds the objects of passes that ended this length of path before the "
            "local map begins");
  visitor.Real("split_m", options.split_m, 0, 10000,
               "an object that was out of sight for this length of path is on another pass when it "
               "comes back");
  visitor.Integer("min_sightings", options.min_sightings, 1, 1000,
                  "objects with fewer sightings on a pass take no part in loop closure");
}

void DescribeFields(FieldVisitor& visitor, LoopViewOptions& options) {
  visitor.Everyday("false: faster, but centimetres less exact where stereo images are given")
      .Flag("enabled", options.enabled,
            "tie cameras of different passes by the ground that both of their stereo images show");
  visitor.Real("every_m", options.every_m, 0.1, 1000, "least path from one tie to the next");
  visitor.Real("ahead_m", options.ahead_m, 0, 100,
               "distance of the ground ahead of a camera that is compared; for images the tools "
               "choose it by the camera");
  visitor.Real("apart_m", options.apart_m, 0, 100,
               "largest distance between the points loop.views.ahead_m ahead of the two cameras");
  visitor.Real("gap_m", options.gap_m, 1, 10000, "least path between the two cameras of a tie");
  visitor.Real("reach_m", options.reach_m, 0, 10000,
               "most path between the two cameras of a tie, closed loops counted as shortcuts; "
               "accurate odometry (loop.views.guess_m) raises it");
  visitor.Real("guess_m", options.guess_m, 0, 10,
               "error of odometry (loop.odometry) up to which two cameras may be tied, even if "
               "their path is longer than loop.views.reach_m");
}

void DescribeFields(FieldVisitor& visitor, LoopOptions& options) {
  visitor.Everyday("false: the trajectory drifts, as without loop closure")
      .Flag("enabled", options.enabled, "close loops");
  visitor.Enum("finder", options.finder, {"tracks", "printed"},
               "how loops are found; tracks: poses that agree over several attempts; printed: the "
               "paper's equations");
  visitor.Nested("layout", options.layout, "the local and the global map (paper IV-A)");
  visitor.Nested("match", options.match, "layout matching (paper IV-B, IV-C)");
  visitor.Nested("tracks", options.tracks, "agreement of consecutive attempts");
  visitor.Nested("acceptance", options.acceptance, "rules that accept and withdraw loops");
  visitor.Nested("views", options.views, "ties between images of different passes");
  visitor.Real("lag_m", options.lag_m, 0, 1000,
               "path from the query camera of a loop to the newest camera; the matched objects lie "
               "around it");
  visitor.Real("sigma_m", options.sigma_m, 0, 100,
               "standard deviation of each loop's translation, added to that of its matches");
  visitor.Real("sigma_rad", options.sigma_rad, 0, 3,
               "standard deviation of each loop's rotation, added to that of its matches");
  visitor.Real("fuse_m", options.fuse_m, 0, 100,
               "matched landmarks that are farther apart than this after the correction do not "
               "become one");
  visitor.Nested("drift", options.drift, "drift of the matched objects (paper IV-D, Eq. 17)");
  visitor.Real("keyframe_m", options.keyframe_m, 0, 1000,
               "path from one vertex of the pose graph to the next");
  visitor.Nested("odometry", options.odometry, "errors of odometry between two vertices");
  visitor.Flag("learn_odometry", options.learn_odometry,
               "at the end of a run, learn the errors of odometry from the closed loops");
  visitor.Everyday("false: one wrong loop bends the whole trajectory")
      .Flag("robust", options.robust,
            "the pose graph may refuse accepted loops; false: it keeps all of them");
  visitor.Nested("graph", options.graph, "pose graph (paper IV-D, Eqs. 20, 21)");
  visitor.Integer("adjust_keyframes", options.adjust_keyframes, 0, 1000000,
                  "up to this number of keyframes all cameras and objects are adjusted after each "
                  "correction; in longer runs only at the end");
  visitor.Nested("paper", options.paper, "the paper's matching (loop.finder: printed)");
}

}  // namespace sslcd
