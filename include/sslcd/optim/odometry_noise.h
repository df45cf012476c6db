// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/fields.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// How far the odometry is off: a random walk, so variances grow with the distance d between two
/// frames, and a share of each turn a: var = floor^2 + walk^2 d (+ turn^2 a^2 for rotations).
/// Height has a walk of its own: slowly pitching cameras and uneven roads make it drift further
/// than the way on the ground.
struct OdometryNoise {
  double translation_floor_m = 0.003;
  double translation_walk = 0.01;  ///< horizontal [m per sqrt(m)]
  double vertical_walk = 0.01;     ///< [m per sqrt(m)]
  double rotation_floor_rad = 2e-4;
  double rotation_walk = 5e-4;  ///< [rad per sqrt(m)]
  double rotation_turn = 2e-3;  ///< [rad per rad turned]
  double scale_prior = 0.05;    ///< standard deviation of the log scale; 0 keeps the scale at one
};
void DescribeFields(FieldVisitor& visitor, OdometryNoise& noise);

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
