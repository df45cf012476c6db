// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/final_trajectory.h"

#include <utility>
#include <vector>

#include "closing/loop_heights.h"
#include "closing/resightings.h"
#include "core/turning_axis.h"

namespace sslcd {
namespace {

// Cameras whose tilt is this share of the expected one are level: odometry that drifts in all six
// degrees of freedom has .8 to 1.2 of it, others have less than .03.
constexpr double kLevel = 0.1;

}  // namespace

FinalTrajectory ChooseTrajectory(const MapState& state, double log_scale,
                                 const LoopEvidence& evidence, const WholeMapOptions& options,
                                 const LoopLedger& loops, const OdometryNoise& noise) {
  const double least = options.refine.least_probability;
  FinalTrajectory result;
  if (least <= 0) return result;
  const Vec3 up = state.gravity().up;
  KeptOdometry kept{true, true, {}};
  std::vector<Pose> odometry;
  for (const FrameRecord& frame : state.frames) odometry.push_back(frame.T_input_cam);
  if (MayBeUp(up, odometry)) {
    result.improvement = ProbabilityOfImprovement(state, log_scale, evidence, options);
    kept.horizontal = result.improvement.horizontal < least;
    if (LargestTiltFactor(state.frames, up, noise) < kLevel) {
      HeightCorrection heights = HeightsByLoops(state.frames, loops, evidence.view_ties, up);
      result.improvement.height = heights.probability;
      if (heights.probability >= least) kept.rise_m = std::move(heights.rise_m);
    } else {
      kept.height = result.improvement.height < least;
    }
  }
  result.keeps_horizontal = kept.horizontal;
  if (!kept.horizontal && !kept.height) return result;
  result.state = state;
  KeepOdometry(kept, *result.state, options.noise);
  return result;
}

}  // namespace sslcd
