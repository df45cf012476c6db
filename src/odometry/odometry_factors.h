// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "odometry/odometry_noise.h"
#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// How far the odometry is really off. Two loops and the two stretches of path between them lead
/// back to where they began, but for what the odometry's errors have added up to. The factors are
/// those of greatest likelihood over such cycles, between loops at least 40 m of path apart, under
/// log-normal priors around one (standard deviation .3). Height and tilt, of which loops tell
/// little, are taken as they are. `graph`: vertices along the path, whose poses need to be upright
/// only; edge k, no loop, from vertex k to the next, with equal variances of all translations and
/// of all rotations; then loops, all of them believed. No loops: both factors are one. `up`: unit
/// vector against gravity in the world.
OdometryFactors LearnOdometryFactors(const PoseGraph& graph, const Vec3& up);

}  // namespace sslcd
