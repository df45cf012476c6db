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

/// VINS's Huber loss of loops bends at 0.1. Whitened residuals times this bend at one standard
/// deviation. It is about the factor, too, by which VINS takes its odometry for less exact than it
/// is (1 m and 1 degree, or 0.1 m and 0.01 rad, from keyframe to keyframe).
constexpr double kWeight = 0.1;

/// W with W^T W = kWeight^2 covariance^-1: W times a residual is whitened and weighted.
Eigen::MatrixXd WeightOf(const Eigen::MatrixXd& covariance);

}  // namespace sslcd::vins
