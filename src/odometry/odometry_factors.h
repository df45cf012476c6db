// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "odometry/odometry_noise.h"
#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// Learns factors on the odometry noise from loops. Two loops and the two path segments between
/// them form a cycle, whose closing error is the accumulated odometry error. The factors maximise
/// the likelihood of the cycles of loops at least 40 m of path apart, with log-normal priors around
/// one (standard deviation .45). Height and tilt are not scaled, since loops hardly measure them.
/// `graph` has vertices along the path (their poses only define the vertical), odometry edges from
/// vertex k to k + 1 with equal variances of all translations and of all rotations, followed by
/// trusted loops. Without loops both factors are one. `up` is the unit vector against gravity in
/// the world. `failures`: those that the information of odometry edge k includes; no factor scales
/// them. Empty: none.
OdometryFactors LearnOdometryFactors(const PoseGraph& graph, const Vec3& up,
                                     const std::vector<OdometryFailures>& failures = {});

}  // namespace sslcd
