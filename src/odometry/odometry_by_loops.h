// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "odometry/odometry_noise.h"
#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// What loops tell of this run's odometry.
struct OdometryByLoops {
  double horizontal = 1, heading = 1;  ///< factors on the noise, as OdometryFactors has them
  /// systematic error of the heading: what turns the odometry back, counterclockwise [rad per metre
  /// of path]
  double turn = 0;
};

/// Learns the errors of odometry from loops. Horizontally and in heading the odometry's steps add
/// up to what the loop measures, but for their errors. With the errors of steps and loops to first
/// order about the current poses, loop i from vertex a to b has the closing error
///   c_i = turn d_i + n_i,   cov(n_i, n_j) = loop_i [i = j] + sum of the steps that both span
/// in the plane of the layout [2 x m, rad], where d_i is what one radian per metre adds up to. The
/// factors on the covariances of steps maximise the likelihood of all closing errors, with
/// log-normal priors around one (standard deviation .45) and a normal one of the turn, over which
/// they are marginalised: over 100 m of path it is expected to be as large as the random walk.
/// Loops at least 40 m of path apart count, which share few objects. Height and tilt are not
/// learnt, since loops hardly measure them.
///
/// `graph` has vertices along the path at the current poses, odometry edges from vertex k to k + 1
/// with equal variances of all translations and of all rotations, followed by trusted loops.
/// `corrected`: the turn that has been taken out of the odometry already; the result includes it.
/// `up` is the unit vector against gravity in the world. `failures`: those that the information of
/// odometry edge k includes; no factor scales them. Empty: none. Without loops nothing is learnt.
OdometryByLoops LearnOdometryByLoops(const PoseGraph& graph, const Vec3& up, double corrected = 0,
                                     const std::vector<OdometryFailures>& failures = {});

}  // namespace sslcd
