// SPDX-License-Identifier: BSD-3-Clause
#include "loop_residual.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace sslcd::vins {
namespace {

constexpr double kDegrees = 180 / M_PI;

}  // namespace

double YawDegrees(const Eigen::Matrix3d& R_world_body) {
  return std::atan2(R_world_body(1, 0), R_world_body(0, 0)) * kDegrees;
}

LoopInfo LoopInfoOf(const Pose& T_old_cur, const Eigen::Matrix3d& R_world_old,
                    const Eigen::Matrix3d& R_world_cur) {
  const Eigen::Matrix3d R_old_cur = T_old_cur.so3().matrix();
  const Eigen::Matrix3d turn = R_world_old * R_old_cur * R_world_cur.transpose();
  const double turn_rad = std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
  const double yaw_rad =
      WrapAngle((YawDegrees(R_world_cur) - YawDegrees(R_world_old)) / kDegrees + turn_rad);
  const Eigen::Quaterniond q(R_old_cur);
  LoopInfo info;
  info << T_old_cur.translation(), q.w(), q.x(), q.y(), q.z(), yaw_rad * kDegrees;
  return info;
}

// T_old_cur Exp([rho phi]) moves the translation by R_old_cur rho and turns the body by phi in its
// own axes.
Eigen::Matrix4d FourDofCovariance(const RelativePose& T_old_cur,
                                  const Eigen::Matrix3d& R_world_old) {
  const Eigen::Matrix3d R_old_cur = T_old_cur.T_a_b.so3().matrix();
  Eigen::Matrix<double, 4, 6> J = Eigen::Matrix<double, 4, 6>::Zero();
  J.topLeftCorner<3, 3>() = R_old_cur;
  J.bottomRightCorner<1, 3>() = kDegrees * (R_world_old * R_old_cur).row(2);
  return J * T_old_cur.covariance * J.transpose();
}

Eigen::Matrix<double, 6, 6> SixDofCovariance(const RelativePose& T_old_cur) {
  Pose::Matrix6 J = Pose::Matrix6::Identity();
  J.topLeftCorner<3, 3>() = T_old_cur.T_a_b.so3().matrix();
  return J * T_old_cur.covariance * J.transpose();
}

Eigen::MatrixXd WeightOf(const Eigen::MatrixXd& covariance, double weight) {
  // With covariance = L L^T: W = weight L^-1.
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  return weight * Eigen::MatrixXd(llt.matrixL())
                      .triangularView<Eigen::Lower>()
                      .solve(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
}

}  // namespace sslcd::vins
