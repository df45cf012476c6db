// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/refine/options.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, RefineOptions& options) {
  visitor.Flag(
      "enabled", options.enabled,
      "look for loops once more and optimise the full map at the end of a run; false: neither");
  visitor.Integer("rounds", options.rounds, 1, 20, "times to optimise, associate anew and fuse");
  visitor.Real("keyframe_m", options.keyframe_m, 0, 1000,
               "a camera of the optimisation every so many metres of path");
  visitor.Real("keyframe_rad", options.keyframe_rad, 0, 7,
               "or after such a turn; all other frames follow");
  visitor.Integer("min_sightings", options.min_sightings, 1, 1000,
                  "objects seen less often do not enter the final map");
  visitor.Real("duplicate_m", options.duplicate_m, 0, 100,
               "landmarks of one label closer than this are one object");
  visitor.Real(
      "moved_m", options.moved_m, 0, 1000,
      "a landmark whose late sightings lie further than this from its early ones has moved");
  visitor.Real("min_seen_share", options.min_seen_share, 0, 1,
               "a movable object seen in fewer of the frames it was in sight for is a chimera of "
               "passers-by");
}

void DescribeFields(FieldVisitor& visitor, LevelOptions& options) {
  visitor.Flag("enabled", options.enabled,
               "turn the odometry back upright where its vertical has drifted");
  visitor.Real("max_slope_rad", options.max_slope_rad, 0, 1.5,
               "no ground is steeper than this on average ...");
  visitor.Real("window_m", options.window_m, 1, 1e5, "... over so many metres of path");
  visitor.Real("slope_rad", options.slope_rad, 0, 1.5,
               "how steep it usually is over that path, a standard deviation; 0: nothing is known");
}

}  // namespace sslcd
