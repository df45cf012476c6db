// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map/map_state.h"
#include "odometry/odometry_noise.h"

namespace sslcd {

/// Standard deviation of the place of an object, seen at `seen_m` of path, to a camera: what
/// odometry drifts by between the two. [m]
double OdometrySigma(const FrameStore& frames, int frame, double seen_m,
                     const OdometryModel& odometry);

/// Adds to `covariance`, of a pose of the camera `query` that objects seen between two path lengths
/// measure, what odometry is off by from there to the camera. `up` is in the frame of the camera.
void AddOdometryBeyond(const FrameStore& frames, int query, double first_m, double last_m,
                       const Vec3& up, const OdometryModel& odometry, Pose::Matrix6& covariance);

}  // namespace sslcd
