// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "refine/optimise_map.h"

namespace sslcd {

/// Probability that an estimate is nearer to the truth than what it started from. With its change d
/// and its error e, the error at the start was e - d, which is larger where e . d < |d|^2 / 2. With
/// the covariance C of e,
///   P = Phi(|d|^2 / (2 sqrt(d^T C d))).
/// `change` is |d|^2, `variance` d^T C d. Half where there is no change.
double ProbabilityNearer(double change, double variance);

/// The same of the camera positions of an optimised map against odometry, after an alignment by
/// shift and yaw, for each part of the run (FrameStore::parts) its own: odometry does not place it.
/// The arguments are those of OptimiseMap(), after it.
ImprovementProbability ProbabilityOfImprovement(const MapState& state, double log_scale,
                                                const LoopEvidence& loops,
                                                const WholeMapOptions& options);

/// Parts of the trajectory that stay as odometry has them.
struct KeptOdometry {
  bool horizontal = false;     ///< horizontal position and heading
  bool height = false;         ///< height and tilt
  std::vector<double> rise_m;  ///< to add to the kept heights, by frame; empty: nothing
};

/// Gives these parts to all frames. Objects follow the frames that saw them. The first part of the
/// run (FrameStore::parts) stays where odometry has it, the others keep their mean places relative
/// to it.
void KeepOdometry(const KeptOdometry& parts, MapState& state, const DetectionNoise& noise);

}  // namespace sslcd
