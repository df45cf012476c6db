// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odometry/odometry_noise.h"

namespace sslcd {

/// Two sightings of a parked object on one pass. The detector's errors and those of odometry
/// between the two frames explain why they put the object in two places. Coordinates [forward,
/// left, up] of GravityFrame.
struct Resighting {
  Eigen::Vector3d moved;      ///< place by the second sighting minus that by the first one [m]
  Eigen::Matrix3d detection;  ///< covariance by the detector's noise as configured [m^2]
  /// covariances by the noise of odometry as configured: of its positions, and of its rotations
  Eigen::Matrix3d translation, rotation;  // [m^2]
  Eigen::Matrix3d odometry() const { return translation + rotation; }
  /// horizontal covariance by failures of odometry, which no factor scales [m^2]
  Eigen::Matrix2d fixed = Eigen::Matrix2d::Zero();
};

/// Learns how accurate this odometry is before any loop closes: the factors on the configured noise
/// that make the resightings most likely, with unknown factors on the detector's noise. Horizontal
/// position and heading have a factor each, with a prior on their ratio, because over the path that
/// an object stays in sight they look similar. They share one if that of position came out larger,
/// because a biased range of the detector looks like errors of position. Height and tilt always
/// share one. The likelihood is a Student-t, since some matches are wrong. Log-normal priors keep
/// factors at one where no resightings tell otherwise. The search begins at `start`.
OdometryFactors FactorsFromResightings(const std::vector<Resighting>& resightings,
                                       const OdometryFactors& start = {});

}  // namespace sslcd
