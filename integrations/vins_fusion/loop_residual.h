// SPDX-License-Identifier: BSD-3-Clause
// A loop in the terms of VINS's two optimisers: their measurement and the covariance of their
// residuals. Knows neither ROS nor VINS; loop_costs.h has the residuals.
#pragma once

#include <Eigen/Core>

#include "sslcd/core/pose.h"

namespace sslcd::vins {

/// KeyFrame::loop_info: translation (3), quaternion w x y z, relative yaw [deg].
using LoopInfo = Eigen::Matrix<double, 8, 1>;

/// The yaw of a body in VINS: of Rz(yaw) Ry(pitch) Rx(roll). [deg]
double YawDegrees(const Eigen::Matrix3d& R_world_body);

/// The measurement of a loop. `R_world_old` and `R_world_cur` are VINS's poses before any
/// optimisation (KeyFrame::vio_R_w_i), z up. The relative yaw is that of these two plus the turn
/// about z that the loop demands, so it is right for a body with any axis up.
LoopInfo LoopInfoOf(const Pose& T_old_cur, const Eigen::Matrix3d& R_world_old,
                    const Eigen::Matrix3d& R_world_cur);

/// Covariance of the 4-DoF residual [translation in the old body's axes (3), yaw in degrees]. z of
/// the world is up.
Eigen::Matrix4d FourDofCovariance(const RelativePose& T_old_cur,
                                  const Eigen::Matrix3d& R_world_old);

/// Covariance of the 6-DoF residual [translation in the old body's axes (3), rotation in the
/// current body's axes (3), rad].
Eigen::Matrix<double, 6, 6> SixDofCovariance(const RelativePose& T_old_cur);

/// VINS takes each of its loops for as exact as a step of its odometry: 1 m (4 DoF) or 0.1 m (6
/// DoF). What sslcd's standard deviations are multiplied with on that scale: a loop with kLikeVinss
/// counts as much as one of VINS's, others by their covariance.
constexpr double kLikeVinss = 0.3;  // [m], typical of object loops
constexpr double kFourDofWeight = kLikeVinss / 1.;
constexpr double kSixDofWeight = kLikeVinss / 0.1;

/// W with W^T W = weight^2 covariance^-1: W times a residual is whitened and weighted.
Eigen::MatrixXd WeightOf(const Eigen::MatrixXd& covariance, double weight);

}  // namespace sslcd::vins
