// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/options.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, WindowOptions& options) {
  visitor.Everyday("false: faster, but the trajectory follows odometry between loops")
      .Flag("enabled", options.enabled, "optimise a sliding window with every keyframe");
  visitor.Everyday("more: smoother and slower")
      .Integer("keyframes", options.keyframes, 2, 100, "cameras in the sliding window");
  visitor.Real("keyframe_m", options.keyframe_m, 0, 100,
               "a new keyframe of the sliding window whenever the path has grown by this");
  visitor.Real("keyframe_rad", options.keyframe_rad, 0, 7,
               "a new keyframe of the sliding window whenever the camera has turned by this");
  visitor.Integer("min_sightings", options.min_sightings, 1, 1000,
                  "objects with fewer sightings stay out of the window (the paper: 'more than 4 "
                  "times')");
}

void DescribeFields(FieldVisitor& visitor, Options& options) {
  visitor.Nested("filter", options.filter, "which detections are used (paper III-A.1)");
  visitor.Nested("colour", options.colour, "colour signature of an object (paper III-A.2)");
  visitor.Nested("noise", options.noise, "errors of the detector");
  visitor.Nested("association", options.association, "data association (paper III-B)");
  visitor.Nested("map", options.map, "life cycle of landmarks");
  visitor.Nested("level", options.level, "gravity alignment of odometry that does not measure it");
  visitor.Nested("window", options.window, "sliding window");
  visitor.Nested("ba", options.ba, "object bundle adjustment (paper III-C)");
  visitor.Nested("loop", options.loop, "loop closure (paper IV)");
  visitor.Nested("refine", options.refine, "full-map optimisation at the end of a run");
}

Options DefaultOptions(Mode mode) {
  Options options;
  if (mode == Mode::kRobust) return options;
  options.colour.method = ColourOptions::Method::kPaper;
  options.association.method = AssociationOptions::Method::kPaper;
  options.map.learn_noise = false;
  options.level.enabled = false;
  options.ba.residual = BaOptions::Residual::kPaper;
  options.ba.solver = BaOptions::Solver::kGaussNewton;
  options.ba.odometry.scale_prior = 0;
  options.refine.rounds = 1;
  options.refine.least_probability = 0;  // the result always stays
  LoopOptions& loop = options.loop;
  loop.finder = LoopOptions::Finder::kPrinted;
  loop.lag_m = 0;                    // the newest camera is the query
  loop.layout.hindsight_m = 0;       // no second search
  loop.robust = false;               // never refuses a loop
  loop.acceptance.withdraw_m = 1e9;  // never withdraws a loop
  loop.acceptance.withdraw_rad = 4;
  loop.adjust_keyframes = 0;
  loop.learn_odometry = false;
  loop.views.enabled = false;
  return options;
}

}  // namespace sslcd
