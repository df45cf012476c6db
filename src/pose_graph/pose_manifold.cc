// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/pose_manifold.h"

#include <lie/se3.h>
#include <lie/se3_map.h>

namespace sslcd {
namespace {

using Jacobian76 = Eigen::Matrix<double, 7, 6, Eigen::RowMajor>;
using Jacobian67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

// d(q Exp(phi))/dphi at 0 = q * [phi/2, 0]: columns of the quaternion's left multiplication,
// halved.
Eigen::Matrix<double, 4, 3> QuaternionPlusJacobian(const double* q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Eigen::Matrix<double, 4, 3> J;
  J << w, -z, y, z, w, -x, -y, x, w, -x, -y, -z;
  return 0.5 * J;
}

}  // namespace

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const lie::SE3<double> T = lie::SE3Map<const double>(x);
  lie::SE3<double> moved =
      T * lie::SE3<double>::Exp(Eigen::Map<const Eigen::Matrix<double, 6, 1>>(delta));
  moved.normalise();
  std::copy_n(moved.data(), 7, x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Jacobian76> J(jacobian);
  J.setZero();
  J.block<4, 3>(0, 3) = QuaternionPlusJacobian(x);
  const lie::SE3<double> T = lie::SE3Map<const double>(x);
  J.block<3, 3>(4, 0) = T.so3().matrix();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const lie::SE3<double> Ty = lie::SE3Map<const double>(y), Tx = lie::SE3Map<const double>(x);
  const auto log = (Tx.inverse() * Ty).Log();
  std::copy_n(log.data(), 6, y_minus_x);
  return true;
}

bool PoseManifold::MinusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Jacobian67> J(jacobian);
  J.setZero();
  // The columns of the quaternion's Jacobian are orthogonal with length 1/2, so its left inverse is
  // 4 J^T.
  J.block<3, 4>(3, 0) = 4. * QuaternionPlusJacobian(x).transpose();
  const lie::SE3<double> T = lie::SE3Map<const double>(x);
  J.block<3, 3>(0, 4) = T.so3().matrix().transpose();
  return true;
}

}  // namespace sslcd
