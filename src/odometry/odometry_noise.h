// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/pose.h"
#include "sslcd/odometry/options.h"

namespace sslcd {

/// Standard deviations of a step of the odometry. [m, rad]
struct OdometrySigmas {
  double horizontal = 0, vertical = 0, rotation = 0;
};
OdometrySigmas SigmasOf(const Pose& T_from_to, const OdometryNoise& noise);

/// Factors on the standard deviations of what loops measure well: the horizontal part of a step,
/// and its heading.
struct OdometryFactors {
  double horizontal = 1, heading = 1;
};

/// Symmetric matrices that whiten the two halves of the error of a step: Log(measured^-1 *
/// T_from_to). [1/m, 1/rad]
struct OdometryWhitening {
  Eigen::Matrix3d translation, rotation;
};

/// `up`: unit vector against gravity, in the frame of the step's second pose, as its error is.
OdometryWhitening WhiteningOf(const OdometrySigmas& sigmas, const OdometryFactors& factors,
                              const Vec3& up);

/// The same as the information of an edge between two poses [translation, rotation].
Eigen::Matrix<double, 6, 6> InformationOf(const OdometrySigmas& sigmas, const Vec3& up);

}  // namespace sslcd
