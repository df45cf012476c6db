// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/frame_store.h"
#include "sslcd/core/pose.h"
#include "sslcd/odometry/options.h"

namespace sslcd {

/// Standard deviations of an odometry step. [m, rad]
struct OdometrySigmas {
  double horizontal = 0, vertical = 0, rotation = 0;
  /// the part of them that failures have added
  double failed_m = 0, failed_rad = 0;
};
OdometrySigmas SigmasOf(const Pose& T_from_to, const OdometryNoise& noise,
                        const OdometryFailures& failures = {});

/// The same for the odometry between two frames, given by index.
OdometrySigmas SigmasBetween(const FrameStore& frames, int from, int to,
                             const OdometryNoise& noise);

/// Factors on the standard deviations of a step: of its horizontal translation and its heading, and
/// of its height and its tilt (roll and pitch).
struct OdometryFactors {
  double horizontal = 1, heading = 1, vertical = 1, tilt = 1;
};

/// The factors on `sigmas` where those on the noise are `factors`. How far odometry fails
/// horizontally, and in heading, is no multiple of its noise. An odometry that keeps its height and
/// its tilt keeps them where it fails, too.
OdometryFactors FactorsWithFailures(const OdometryFactors& factors, const OdometrySigmas& sigmas);

/// The noise of a certain odometry: the configured one with factors learnt from the run.
struct OdometryModel {
  OdometryNoise noise;
  OdometryFactors factors;
};

/// Symmetric whitening matrices of the two halves of the error Log(measured^-1 * T_from_to) of a
/// step. [1/m, 1/rad]
struct OdometryWhitening {
  Eigen::Matrix3d translation, rotation;
};

/// `up` is the unit vector against gravity in the frame of the step's second pose, like the error.
OdometryWhitening WhiteningOf(const OdometrySigmas& sigmas, const OdometryFactors& on_noise,
                              const Vec3& up);

/// The information of an edge between two poses [translation, rotation].
Eigen::Matrix<double, 6, 6> InformationOf(const OdometrySigmas& sigmas, const Vec3& up,
                                          const OdometryFactors& factors = {});

}  // namespace sslcd
