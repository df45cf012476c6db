// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map/map_state.h"
#include "odometry/odometry_noise.h"

namespace sslcd {

/// Standard deviation of the place of an object, seen at `seen_m` of path, to a camera: what
/// odometry drifts by between the two. [m]
double OdometrySigma(const FrameStore& frames, int frame, double seen_m,
                     const OdometryModel& odometry);

/// Covariance of the camera `query` to the nearest one between two path lengths, by odometry; zero
/// between them. Adds to that of a pose measured by objects seen there. `up` is in the frame of the
/// camera.
Pose::Matrix6 OdometryBeyond(const FrameStore& frames, int query, double first_m, double last_m,
                             const Vec3& up, const OdometryModel& odometry);

}  // namespace sslcd
