// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/detection_noise.h"

#include <Eigen/Geometry>

namespace sslcd {
namespace {

// In the axes of RayFrame. [m^2]
Vec3 Variances(const DetectionSigmas& sigmas) {
  return {sigmas.radial * sigmas.radial, sigmas.lateral * sigmas.lateral,
          sigmas.vertical * sigmas.vertical};
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, DetectionNoise& noise) {
  visitor.Everyday("larger: wider gates, and detections move the trajectory less")
      .Real("radial_m", noise.radial_m, 1e-4, 100,
            "standard deviation of a position along the viewing ray, at range 0");
  visitor.Everyday("larger: far detections are trusted less")
      .Real("radial_per_m", noise.radial_per_m, 0, 1,
            "growth of the standard deviation along the viewing ray, per metre of range");
  visitor.Real("lateral_m", noise.lateral_m, 1e-4, 100,
               "horizontal standard deviation of a position across the viewing ray, at range 0");
  visitor.Real("lateral_per_m", noise.lateral_per_m, 0, 1,
               "growth of the standard deviation across the viewing ray, per metre of range");
  visitor.Real("vertical_m", noise.vertical_m, 1e-4, 100,
               "vertical standard deviation of a position, at range 0");
  visitor.Real("vertical_per_m", noise.vertical_per_m, 0, 1,
               "growth of the vertical standard deviation, per metre of range");
  visitor.Real("yaw_rad", noise.yaw_rad, 1e-4, 4, "standard deviation of a heading, at range 0");
  visitor.Real("yaw_per_m", noise.yaw_per_m, 0, 1,
               "growth of the standard deviation of a heading, rad per metre of range");
  visitor.Real("initial_scale", noise.initial_scale, 0.1, 100,
               "factor on all standard deviations before the run has learnt its own "
               "(map.learn_noise)");
}

DetectionSigmas SigmasAt(double range_m, const DetectionNoise& noise, const NoiseScale& scale) {
  return {(noise.radial_m + noise.radial_per_m * range_m) * scale.radial,
          (noise.lateral_m + noise.lateral_per_m * range_m) * scale.lateral,
          (noise.vertical_m + noise.vertical_per_m * range_m) * scale.vertical,
          (noise.yaw_rad + noise.yaw_per_m * range_m) * scale.yaw};
}

Eigen::Matrix3d RayFrame(const Vec3& point_cam) {
  const double range = point_cam.norm();
  const Vec3 ray = range > 1e-9 ? Vec3(point_cam / range) : Vec3(Vec3::UnitZ());
  Vec3 across = Vec3::UnitY().cross(ray);  // y points down in the image, so this one is horizontal
  if (across.norm() < 1e-6) across = Vec3::UnitX();
  across.normalize();
  Eigen::Matrix3d rows;
  rows << ray.transpose(), across.transpose(), ray.cross(across).transpose();
  return rows;
}

Eigen::Matrix3d PositionCovariance(const Vec3& point_cam, const DetectionSigmas& sigmas) {
  const Eigen::Matrix3d rows = RayFrame(point_cam);
  return rows.transpose() * Variances(sigmas).asDiagonal() * rows;
}

Eigen::Matrix3d PositionInformation(const Vec3& point_cam, const DetectionSigmas& sigmas) {
  const Eigen::Matrix3d rows = RayFrame(point_cam);
  return rows.transpose() * Variances(sigmas).cwiseInverse().asDiagonal() * rows;
}

}  // namespace sslcd
