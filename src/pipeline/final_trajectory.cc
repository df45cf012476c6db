// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/final_trajectory.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "closing/loop_heights.h"
#include "closing/parts.h"
#include "closing/resightings.h"
#include "core/turning_axis.h"

namespace sslcd {
namespace {

// Cameras whose tilt is this share of the expected one are level: odometry that drifts in all six
// degrees of freedom has .8 to 1.2 of it, others have less than .03.
constexpr double kLevel = 0.1;

// What the result has to be nearer to the truth with. Odometry in parts is no trajectory of the
// whole run that a result could make worse, and odometry between loops that join parts tears the
// map: then the more probable of the two counts.
double LeastProbability(const FrameStore& frames, const LoopLedger& loops,
                        const RefineOptions& options) {
  constexpr double kAsProbable = 0.5;
  const std::vector<int> joined = JoinParts(frames, loops.AcceptedEdges());
  for (std::size_t k = 0; k < joined.size(); ++k)
    if (joined[k] != static_cast<int>(k)) return std::min(kAsProbable, options.least_probability);
  return options.least_probability;
}

}  // namespace

ImprovementProbability ChooseTrajectory(MapState& state, double& log_scale,
                                        const LoopEvidence& evidence,
                                        const WholeMapOptions& options, const LoopLedger& loops,
                                        const OdometryNoise& noise) {
  ImprovementProbability improvement;
  if (options.refine.least_probability <= 0) return improvement;
  const double least = LeastProbability(state.frames, loops, options.refine);
  const Vec3 up = state.gravity().up;
  KeptOdometry kept{true, true, {}};
  std::vector<Pose> odometry;
  for (const FrameRecord& frame : state.frames) odometry.push_back(frame.T_input_cam);
  if (MayBeUp(up, odometry)) {
    improvement = ProbabilityOfImprovement(state, log_scale, evidence, options);
    kept.horizontal = improvement.horizontal < least;
    if (LargestTiltFactor(state.frames, up, noise) < kLevel) {
      HeightCorrection heights = HeightsByLoops(state.frames, loops, evidence.view_ties, up);
      improvement.height = heights.probability;
      if (heights.probability >= least) kept.rise_m = std::move(heights.rise_m);
    } else {
      kept.height = improvement.height < least;
    }
  }
  if (kept.horizontal) log_scale = 0;
  if (kept.horizontal || kept.height) KeepOdometry(kept, state, options.noise);
  return improvement;
}

}  // namespace sslcd
