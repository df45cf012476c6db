// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_noise.h"

#include <algorithm>
#include <cmath>

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, OdometryNoise& noise) {
  visitor.Real("translation_floor_m", noise.translation_floor_m, 1e-6, 10,
               "standard deviation of the translation between any two frames");
  visitor.Real("translation_walk", noise.translation_walk, 0, 10,
               "random walk of the horizontal translation, m per sqrt(m) of path");
  visitor.Real("vertical_walk", noise.vertical_walk, 0, 10,
               "random walk of the vertical translation, m per sqrt(m) of path");
  visitor.Real("rotation_floor_rad", noise.rotation_floor_rad, 1e-7, 1,
               "standard deviation of the rotation between any two frames");
  visitor.Real("rotation_walk", noise.rotation_walk, 0, 1,
               "random walk of the rotation, rad per sqrt(m) of path");
  visitor.Real("rotation_turn", noise.rotation_turn, 0, 1,
               "standard deviation of the rotation per turn, rad per rad");
  visitor.Real("scale_prior", noise.scale_prior, 0, 1,
               "standard deviation of the logarithm of the odometry's scale; 0: the scale is one");
}

OdometrySigmas SigmasOf(const Pose& T_from_to, const OdometryNoise& noise,
                        const OdometryFailures& failures) {
  const double root = std::sqrt(T_from_to.translation().norm());
  const double turn = T_from_to.so3().Log().norm();
  const double walked = std::hypot(noise.rotation_floor_rad, noise.rotation_walk * root);
  const double jumped = std::sqrt(failures.translation_m2);
  const double turned = std::sqrt(failures.rotation_rad2);
  return {std::hypot(noise.translation_floor_m, noise.translation_walk * root, jumped),
          std::hypot(noise.translation_floor_m, noise.vertical_walk * root, jumped),
          std::hypot(walked, noise.rotation_turn * turn, turned), jumped, turned};
}

OdometrySigmas SigmasBetween(const FrameStore& frames, int from, int to,
                             const OdometryNoise& noise) {
  return SigmasOf(frames[from].T_odom_cam.inverse() * frames[to].T_odom_cam, noise,
                  FailuresBetween(frames, from, to));
}

OdometryFactors FactorsWithFailures(const OdometryFactors& factors, const OdometrySigmas& sigmas) {
  const auto on_sum = [](double factor, double sigma, double failed) {
    const double share = failed > 0 ? failed / sigma : 0;
    return std::hypot(factor * std::sqrt(std::max(0., 1 - share * share)), share);
  };
  OdometryFactors sum = factors;
  sum.horizontal = on_sum(factors.horizontal, sigmas.horizontal, sigmas.failed_m);
  sum.heading = on_sum(factors.heading, sigmas.rotation, sigmas.failed_rad);
  return sum;
}

OdometryWhitening WhiteningOf(const OdometrySigmas& sigmas, const OdometryFactors& on_noise,
                              const Vec3& up) {
  const OdometryFactors factors = FactorsWithFailures(on_noise, sigmas);
  const Eigen::Matrix3d vertical = up * up.transpose(),
                        horizontal = Eigen::Matrix3d::Identity() - vertical;
  return {horizontal / (factors.horizontal * sigmas.horizontal) +
              vertical / (factors.vertical * sigmas.vertical),
          (horizontal / factors.tilt + vertical / factors.heading) / sigmas.rotation};
}

Eigen::Matrix<double, 6, 6> InformationOf(const OdometrySigmas& sigmas, const Vec3& up,
                                          const OdometryFactors& factors) {
  const OdometryWhitening whitening = WhiteningOf(sigmas, factors, up);
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  information.topLeftCorner<3, 3>() = whitening.translation * whitening.translation;
  information.bottomRightCorner<3, 3>() = whitening.rotation * whitening.rotation;
  return information;
}

}  // namespace sslcd
