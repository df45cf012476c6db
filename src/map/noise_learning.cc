// SPDX-License-Identifier: BSD-3-Clause
#include "map/noise_learning.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

// Step of the logarithm of the scale per detection: about a hundred detections for a factor of ten.
// Set by hand.
constexpr double kLearningRate = 0.03;
constexpr double kMinScale = 0.5, kMaxScale = 40.;  // sanity bounds
constexpr double kMedianOfGaussian = 0.6745;        // median of |x|, x ~ N(0, 1)

void Learn(double normalised_error, double& scale) {
  const bool above = std::abs(normalised_error) > kMedianOfGaussian * scale;
  scale *= std::exp(kLearningRate * (above ? 1 : -1));
  scale = std::clamp(scale, kMinScale, kMaxScale);
}

}  // namespace

void LearnNoise(const MapLandmark& landmark, const Detection& detection, const Pose& T_world_cam,
                const GravityFrame& gravity, const DetectionNoise& noise, NoiseScale& scale) {
  const Vec3 point_cam = detection.T_cam_object.translation();
  const Pose T_cam_object = T_world_cam.inverse() * ToPose(landmark.pose, gravity);
  const Vec3 error = RayFrame(point_cam) * (point_cam - T_cam_object.translation());
  const DetectionSigmas unit = SigmasAt(point_cam.norm(), noise, NoiseScale::Uniform(1.));
  Learn(error.x() / unit.radial, scale.radial);
  Learn(error.y() / unit.lateral, scale.lateral);
  Learn(error.z() / unit.vertical, scale.vertical);
  if (landmark.symmetry == Symmetry::kFull) return;
  const double yaw = gravity.YawOf((T_world_cam * detection.T_cam_object).so3());
  Learn(WrapAngle(yaw - landmark.pose.yaw, M_PI) / unit.yaw, scale.yaw);
}

}  // namespace sslcd
