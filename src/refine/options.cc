// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/refine/options.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, RefineOptions& options) {
  visitor.Everyday("false: a run ends sooner, with a less exact trajectory and map")
      .Flag("enabled", options.enabled,
            "at the end of a run, search for loops once more and optimise the full map");
  visitor.Integer("rounds", options.rounds, 1, 20,
                  "rounds of the full-map optimisation, each: optimise, associate, fuse");
  visitor.Real("keyframe_m", options.keyframe_m, 0, 1000,
               "the full-map optimisation takes a camera whenever the path has grown by this");
  visitor.Real("keyframe_rad", options.keyframe_rad, 0, 7,
               "the full-map optimisation takes a camera whenever it has turned by this");
  visitor.Everyday("higher: fewer objects in the map, and more certain ones")
      .Integer("min_sightings", options.min_sightings, 1, 1000,
               "objects with fewer sightings do not enter the final map");
  visitor.Real("duplicate_m", options.duplicate_m, 0, 100,
               "landmarks of one label that are closer than this become one object");
  visitor.Real("moved_m", options.moved_m, 0, 1000,
               "a landmark whose late sightings are farther than this from its early ones has "
               "moved and leaves the map");
  visitor.Real("min_seen_share", options.min_seen_share, 0, 1,
               "a movable object seen in a smaller share of the frames that it was in sight for is "
               "taken for several passing ones and leaves the map");
  visitor.Real("least_probability", options.least_probability, 0, 1,
               "least probability that the optimised trajectory is better than odometry; below it "
               "odometry stays (horizontally and in height); 0: never");
}

void DescribeFields(FieldVisitor& visitor, LevelOptions& options) {
  visitor.Everyday("false: use it where odometry measures gravity")
      .Flag("enabled", options.enabled,
            "turn the odometry upright again where its vertical has drifted");
  visitor.Real("max_slope_rad", options.max_slope_rad, 0, 1.5,
               "steepest mean slope of the ground over level.window_m of path");
  visitor.Real("window_m", options.window_m, 1, 1e5,
               "length of path over which the slope of the ground is averaged");
  visitor.Real("slope_rad", options.slope_rad, 0, 1.5,
               "standard deviation of the ground's mean slope over level.window_m of path; 0: the "
               "slope is not used");
}

}  // namespace sslcd
