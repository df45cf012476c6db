// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// The noise of a 3D detector as a function of range: sigma = (base + slope * range) * scale. The
/// shape fits LiDAR and stereo detectors, whose errors differ by a factor of 3 to 10. That factor
/// is the NoiseScale below, which a run learns from the scatter of the detections around the
/// landmarks.
struct DetectionNoise {
  double radial_m = 0.06, radial_per_m = 0.003;       ///< standard deviation along the viewing ray
  double lateral_m = 0.04, lateral_per_m = 0.0015;    ///< horizontal, across the ray
  double vertical_m = 0.05, vertical_per_m = 0.0005;  ///< across the ray, vertical
  double yaw_rad = 0.02, yaw_per_m = 0.0005;          ///< heading [rad, rad/m]
  double size_relative = 0.05;  ///< no key, for the simulator: share of each dimension
  double initial_scale = 2.;    ///< factor on all components before the run has learnt its own
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

/// The standard deviations at a range.
DetectionSigmas SigmasAt(double range_m, const DetectionNoise& noise, const NoiseScale& scale);

/// The rotation from the camera frame to [radial, lateral, vertical] for a point in the camera
/// frame. Rows: unit vectors along the viewing ray, across it (horizontal in the camera), and up in
/// the image.
Eigen::Matrix3d RayFrame(const Vec3& point_cam);

/// Covariance of a detection's position in the camera frame. [m^2]
Eigen::Matrix3d PositionCovariance(const Vec3& point_cam, const DetectionSigmas& sigmas);
/// Its inverse. [1/m^2]
Eigen::Matrix3d PositionInformation(const Vec3& point_cam, const DetectionSigmas& sigmas);

}  // namespace sslcd
