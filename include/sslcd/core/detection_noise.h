// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/fields.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// How far a 3D detector is off, as a function of range: sigma = (base + slope * range) * scale.
/// The shape holds for detectors as different as LiDAR and stereo ones, whose errors differ by a
/// factor of 3 to 10; that factor is the NoiseScale below, which is learnt during the run from the
/// detections' own scatter about the landmarks.
struct DetectionNoise {
  double radial_m = 0.06, radial_per_m = 0.003;     ///< along the viewing ray
  double lateral_m = 0.04, lateral_per_m = 0.0015;  ///< across the ray, horizontal
  double vertical_m = 0.05, vertical_per_m = 0.0005;
  double yaw_rad = 0.02, yaw_per_m = 0.0005;
  double size_relative = 0.05;  ///< no key, the simulator reads it: of each dimension, share
  double initial_scale = 2.;    ///< of every component, before anything has been learnt
};
void DescribeFields(FieldVisitor& visitor, DetectionNoise& noise);

/// Learnt factors on the standard deviations.
struct NoiseScale {
  double radial = 1, lateral = 1, vertical = 1, yaw = 1;

  static NoiseScale Uniform(double scale) { return {scale, scale, scale, scale}; }
};

/// Standard deviations of one detection. [m, m, m, rad]
struct DetectionSigmas {
  double radial = 0, lateral = 0, vertical = 0, yaw = 0;
};

DetectionSigmas SigmasAt(double range_m, const DetectionNoise& noise, const NoiseScale& scale);

/// Rows: unit vectors along the viewing ray, across it (horizontal in the camera), and up the
/// image, for a point in the camera frame. Turns camera-frame errors into [radial, lateral,
/// vertical].
Eigen::Matrix3d RayFrame(const Vec3& point_cam);

/// Covariance of a detection's position in the camera frame. [m^2]
Eigen::Matrix3d PositionCovariance(const Vec3& point_cam, const DetectionSigmas& sigmas);

}  // namespace sslcd
