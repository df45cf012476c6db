// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/frame_store.h"
#include "odometry/odometry_noise.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// The odometry between two frames, as an edge of a pose graph.
struct OdometryEdge {
  Pose T_from_to;  ///< metric
  Eigen::Matrix<double, 6, 6> information;

  RelativePose Measurement() const { return {T_from_to, information.inverse()}; }
};

/// Makes the edge between two frames, given by index. `up` is the unit vector against gravity in
/// the world, `scale` is metres per odometry metre. Where odometry was lost in between, the edge
/// measures the current poses: nothing is known, so nothing moves them, but they are not free.
OdometryEdge OdometryBetween(const FrameStore& frames, int from, int to, const OdometryModel& model,
                             const Vec3& up, double scale);

}  // namespace sslcd
