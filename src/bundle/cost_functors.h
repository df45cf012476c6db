// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lie/se3.h>
#include <lie/se3_map.h>

#include <cmath>

#include "odometry/odometry_noise.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/pose.h"

/// Residuals for automatic differentiation (opt-in header; needs no Ceres by itself).
/// Parameter blocks: a camera is T_world_cam as [qx qy qz qw tx ty tz]; an object is [x y z yaw] in
/// the world [m, rad]; the scale is log(metres per odometry metre).
namespace sslcd {

/// Robust form of Eq. 8: the whitened difference of a measured and an estimated upright object.
/// Residual [radial, lateral, vertical, yaw]: position error along and across the ray to
/// `expected`, and heading error in the world, wrapped to one yaw period.
struct ObjectResidual {
  Pose T_cam_object;  ///< measured
  /// Where the object is taken to be in the camera frame, for the ray and the sigmas only [m].
  /// Along the measured ray, which a detection's own error turns, an object that is nearer has
  /// smaller errors across it: the estimate would shrink by the relative variance of the range.
  Vec3 expected;
  DetectionSigmas sigmas;
  double yaw_period = 0;  ///< [rad]; 0: no yaw, the fourth component is zero
  GravityFrame gravity;

  template <class T>
  bool operator()(const T* camera, const T* object, T* residual) const {
    using std::atan2;
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const lie::SE3<T> T_world_cam = lie::SE3Map<const T>(camera);
    const Vector3 in_camera = T_world_cam.inverse() * Vector3(object[0], object[1], object[2]);
    const Vec3& measured = T_cam_object.translation();
    const Eigen::Matrix3d rows = RayFrame(expected);
    const Vector3 error = rows.cast<T>() * (measured.cast<T>() - in_camera);
    residual[0] = error[0] / sigmas.radial;
    residual[1] = error[1] / sigmas.lateral;
    residual[2] = error[2] / sigmas.vertical;
    residual[3] = T(0);
    if (yaw_period > 0) {
      const Vec3 heading_cam = T_cam_object.so3() * Vec3(Vec3::UnitX());
      const Vector3 heading = T_world_cam.so3() * Vector3(heading_cam.cast<T>());
      const T yaw =
          atan2(heading.dot(gravity.left.cast<T>()), heading.dot(gravity.forward.cast<T>())) -
          object[3];
      residual[3] = Wrap(yaw) / sigmas.yaw;
    }
    return true;
  }

 private:
  static double Value(double x) { return x; }
  template <class Jet>
  static double Value(const Jet& x) {
    return x.a;
  }
  template <class T>
  T Wrap(const T& angle) const {
    return angle - T(yaw_period * std::round(Value(angle) / yaw_period));
  }
};

/// Eq. 8 as printed: r = log(T_wo^-1 T_wc T_co), 6 components [rho, phi] in the object frame,
/// unweighted: metres and radians have equal weight. The object is upright (the paper sets roll and
/// pitch to zero).
struct PaperObjectResidual {
  Pose T_cam_object;
  GravityFrame gravity;

  template <class T>
  bool operator()(const T* camera, const T* object, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const lie::SE3<T> T_world_cam = lie::SE3Map<const T>(camera);
    const Vec3 up = gravity.up;
    const lie::SO3<T> turn = lie::SO3<T>::Exp(Vector3(up.cast<T>() * object[3]));
    const lie::SE3<T> T_world_object(turn * gravity.Upright(0.).template cast<T>(),
                                     Vector3(object[0], object[1], object[2]));
    const auto log =
        (T_world_object.inverse() * T_world_cam * T_cam_object.template cast<T>()).Log();
    for (int i = 0; i < 6; ++i) residual[i] = log[i];
    return true;
  }
};

/// The odometry between consecutive cameras with a common scale factor of the translations: r =
/// diag(W_t, W_r) Log((s T_ij)^-1 T_i^-1 T_j), components [rho / exp(log_scale), phi], s T = (R,
/// exp(log_scale) t). The sigma of a translation refers to the unscaled odometry.
struct OdometryResidual {
  Pose T_from_to;  ///< odometry, as measured
  OdometryWhitening whiten;

  template <class T>
  bool operator()(const T* from, const T* to, const T* log_scale, T* residual) const {
    using std::exp;
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const lie::SE3<T> T_world_from = lie::SE3Map<const T>(from),
                      T_world_to = lie::SE3Map<const T>(to);
    lie::SE3<T> measured = T_from_to.template cast<T>();
    measured.translation() = Vector3(measured.translation() * exp(log_scale[0]));
    const auto log = (measured.inverse() * (T_world_from.inverse() * T_world_to)).Log();
    const T unscaled = exp(-log_scale[0]);
    Eigen::Map<Vector3> translation(residual), rotation(residual + 3);
    translation = whiten.translation.cast<T>() * Vector3(log.template head<3>() * unscaled);
    rotation = whiten.rotation.cast<T>() * Vector3(log.template tail<3>());
    return true;
  }
};

/// A prior of a camera pose that fixes the gauge: r = diag(1/sigma) Log(T_0^-1 T).
struct PosePrior {
  Pose T_world_cam;
  double sigma_translation = 1, sigma_rotation = 1;

  template <class T>
  bool operator()(const T* camera, T* residual) const {
    const lie::SE3<T> T_now = lie::SE3Map<const T>(camera);
    const auto log = (T_world_cam.inverse().template cast<T>() * T_now).Log();
    for (int i = 0; i < 3; ++i) {
      residual[i] = log[i] / sigma_translation;
      residual[i + 3] = log[i + 3] / sigma_rotation;
    }
    return true;
  }
};

/// A prior of an upright camera on sloped ground: r = (R_world_cam up_in_cam - up) / sigma,
/// approximately the slope's angle in sigmas. `up` is a unit vector in the world.
struct SlopeResidual {
  Vec3 up_in_cam;    ///< unit vector
  double sigma = 1;  ///< [rad]

  template <class T>
  bool operator()(const T* camera, const T* up, T* residual) const {
    const lie::SE3<T> T_world_cam = lie::SE3Map<const T>(camera);
    const Eigen::Matrix<T, 3, 1> stands =
        T_world_cam.so3() * Eigen::Matrix<T, 3, 1>(up_in_cam.cast<T>());
    for (int i = 0; i < 3; ++i) residual[i] = (stands[i] - up[i]) / sigma;
    return true;
  }
};

/// A prior of a direction as unit vector: r = (x - mean) / sigma.
struct DirectionPrior {
  Vec3 mean;
  double sigma = 1;  ///< [rad]

  template <class T>
  bool operator()(const T* x, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (x[i] - mean[i]) / sigma;
    return true;
  }
};

/// r = (x - mean) / sigma.
struct ScalarPrior {
  double mean = 0, sigma = 1;

  template <class T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = (x[0] - T(mean)) / sigma;
    return true;
  }
};

}  // namespace sslcd
