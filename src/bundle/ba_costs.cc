// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/ba_costs.h"

#include "pose_graph/pose_manifold.h"

namespace sslcd {
namespace {

// Converts a derivative in the tangent space to the seven parameters; PlusJacobian cancels the
// factor.
template <int kRows>
void StoreAmbient(const Eigen::Matrix<double, kRows, 6>& J, const double* pose, double* jacobian) {
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> minus;
  PoseManifold().MinusJacobian(pose, minus.data());
  Eigen::Map<Eigen::Matrix<double, kRows, 7, Eigen::RowMajor>> ambient(jacobian);
  // Rotation and translation are independent, so two products of half the size suffice.
  ambient.template leftCols<4>() =
      J.template rightCols<3>().lazyProduct(minus.bottomLeftCorner<3, 4>());
  ambient.template rightCols<3>() =
      J.template leftCols<3>().lazyProduct(minus.topRightCorner<3, 3>());
}

}  // namespace

ObjectCost::ObjectCost(const ObjectResidual& residual)
    : forward_(residual.gravity.forward),
      left_(residual.gravity.left),
      yaw_period_(residual.yaw_period) {
  const DetectionSigmas& sigmas = residual.sigmas;
  const Vec3 weight(1 / sigmas.radial, 1 / sigmas.lateral, 1 / sigmas.vertical);
  whiten_ = weight.asDiagonal() * RayFrame(residual.expected);
  measured_ = whiten_ * residual.T_cam_object.translation();
  heading_cam_ = residual.T_cam_object.so3() * Vec3(Vec3::UnitX());
  yaw_weight_ = yaw_period_ > 0 ? 1 / sigmas.yaw : 0.;
}

bool ObjectCost::Evaluate(double const* const* blocks, double* residual, double** jacobians) const {
  const Pose T_world_cam = lie::SE3ConstMap<double>(blocks[0]);
  const Eigen::Matrix3d R = T_world_cam.so3().matrix();
  const Vec3 in_camera =
      R.transpose() * (Vec3(blocks[1][0], blocks[1][1], blocks[1][2]) - T_world_cam.translation());
  Eigen::Map<Eigen::Vector4d> r(residual);
  r.head<3>() = measured_ - whiten_ * in_camera;
  const Vec3 heading = R * heading_cam_;
  const double ahead = heading.dot(forward_), aside = heading.dot(left_);
  r[3] = yaw_weight_ > 0
             ? yaw_weight_ * WrapAngle(std::atan2(aside, ahead) - blocks[1][3], yaw_period_)
             : 0.;
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) {
    Eigen::Matrix<double, 4, 6> J;
    J.topLeftCorner<3, 3>() = whiten_;
    for (int i = 0; i < 3; ++i)
      J.block<1, 3>(i, 3) = in_camera.cross(Vec3(whiten_.row(i))).transpose();
    J.bottomLeftCorner<1, 3>().setZero();
    const Vec3 yaw_gradient = (ahead * left_ - aside * forward_) / (ahead * ahead + aside * aside);
    J.bottomRightCorner<1, 3>().setZero();
    if (yaw_weight_ > 0)
      J.block<1, 3>(3, 3) = yaw_weight_ * heading_cam_.cross(R.transpose() * yaw_gradient);
    StoreAmbient<4>(J, blocks[0], jacobians[0]);
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> J(jacobians[1]);
    J.setZero();
    J.topLeftCorner<3, 3>() = -whiten_ * R.transpose();
    J(3, 3) = -yaw_weight_;
  }
  return true;
}

OdometryCost::OdometryCost(const OdometryResidual& residual) : residual_(residual) {}

bool OdometryCost::Evaluate(double const* const* blocks, double* residual,
                            double** jacobians) const {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Pose T_world_from = lie::SE3ConstMap<double>(blocks[0]),
             T_world_to = lie::SE3ConstMap<double>(blocks[1]);
  const Vec3 metric = std::exp(*blocks[2]) * residual_.T_from_to.translation();
  const Pose B = T_world_from.inverse() * T_world_to;
  const Vec6 e = (Pose(residual_.T_from_to.so3(), metric).inverse() * B).Log();
  Matrix6 whiten = Matrix6::Zero();
  whiten.topLeftCorner<3, 3>() = std::exp(-*blocks[2]) * residual_.whiten.translation;
  whiten.bottomRightCorner<3, 3>() = residual_.whiten.rotation;
  Eigen::Map<Vec6> r(residual);
  r.noalias() = whiten * e;
  if (jacobians == nullptr) return true;
  // e(d_to) = Log(E Exp(d_to)). A perturbation d of `from` equals -Adj(B^-1) d of `to`.
  const Matrix6 J_to = whiten.lazyProduct(Matrix6(Pose::RightJacobianInverse(e)));
  if (jacobians[0] != nullptr) {
    const Matrix6 J_from = -J_to.lazyProduct(Matrix6(B.inverse().Adj()));
    StoreAmbient<6>(J_from, blocks[0], jacobians[0]);
  }
  if (jacobians[1] != nullptr) StoreAmbient<6>(J_to, blocks[1], jacobians[1]);
  if (jacobians[2] != nullptr) {
    Eigen::Map<Vec6> J(jacobians[2]);
    J = -(J_to.leftCols<3>() * Vec3(B.so3().inverse() * metric));
    J.head<3>() -= r.head<3>();
  }
  return true;
}

}  // namespace sslcd
