// SPDX-License-Identifier: BSD-3-Clause
// The residuals of a loop in VINS's two optimisers, with a full covariance in place of VINS's equal
// weights. They take the parameter blocks that VINS's take.
#pragma once

#include <ceres/autodiff_cost_function.h>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "loop_residual.h"

namespace sslcd::vins {

/// Blocks: yaw [deg] and position of the old body, the same of the current one.
struct FourDofLoopCost {
  Eigen::Vector3d t_old_cur;
  double relative_yaw_deg = 0;
  /// of the old body, without its yaw: Ry(pitch) Rx(roll)
  Eigen::Matrix3d R_tilt;
  Eigen::Matrix4d weight;

  template <typename T>
  bool operator()(const T* yaw_old, const T* t_old, const T* yaw_cur, const T* t_cur,
                  T* residuals) const {
    using Vec3T = Eigen::Matrix<T, 3, 1>;
    using Vec4T = Eigen::Matrix<T, 4, 1>;
    const Vec3T step = Eigen::Map<const Vec3T>(t_cur) - Eigen::Map<const Vec3T>(t_old);
    const T angle = yaw_old[0] * T(M_PI / 180);
    using std::cos;
    using std::sin;
    const Vec3T turned(cos(angle) * step[0] + sin(angle) * step[1],
                       cos(angle) * step[1] - sin(angle) * step[0], step[2]);
    Vec4T r;
    r.template head<3>() =
        R_tilt.transpose().template cast<T>() * turned - t_old_cur.template cast<T>();
    T yaw = yaw_cur[0] - yaw_old[0] - T(relative_yaw_deg);
    while (yaw > T(180)) yaw -= T(360);
    while (yaw < T(-180)) yaw += T(360);
    r[3] = yaw;
    Eigen::Map<Vec4T>{residuals} = weight.template cast<T>() * r;
    return true;
  }
  static ceres::CostFunction* Create(const FourDofLoopCost& cost) {
    return new ceres::AutoDiffCostFunction<FourDofLoopCost, 4, 1, 3, 1, 3>(
        new FourDofLoopCost(cost));
  }
};

/// Blocks: quaternion w x y z and position of the old body, the same of the current one.
struct SixDofLoopCost {
  Eigen::Vector3d t_old_cur;
  Eigen::Quaterniond q_old_cur;
  Eigen::Matrix<double, 6, 6> weight;

  template <typename T>
  bool operator()(const T* q_old, const T* t_old, const T* q_cur, const T* t_cur,
                  T* residuals) const {
    using Vec3T = Eigen::Matrix<T, 3, 1>;
    using Vec6T = Eigen::Matrix<T, 6, 1>;
    const Eigen::Quaternion<T> old_q(q_old[0], q_old[1], q_old[2], q_old[3]);
    const Eigen::Quaternion<T> cur_q(q_cur[0], q_cur[1], q_cur[2], q_cur[3]);
    const Vec3T step = Eigen::Map<const Vec3T>(t_cur) - Eigen::Map<const Vec3T>(t_old);
    const Eigen::Quaternion<T> error =
        q_old_cur.conjugate().template cast<T>() * (old_q.conjugate() * cur_q);
    Vec6T r;
    r.template head<3>() = old_q.conjugate() * step - t_old_cur.template cast<T>();
    // q and -q are the same rotation
    r.template tail<3>() = error.vec() * T(error.w() < T(0) ? -2. : 2.);
    Eigen::Map<Vec6T>{residuals} = weight.template cast<T>() * r;
    return true;
  }
  static ceres::CostFunction* Create(const SixDofLoopCost& cost) {
    return new ceres::AutoDiffCostFunction<SixDofLoopCost, 6, 4, 3, 4, 3>(new SixDofLoopCost(cost));
  }
};

}  // namespace sslcd::vins
