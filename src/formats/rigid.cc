// SPDX-License-Identifier: BSD-3-Clause
#include "formats/rigid.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace sslcd {

std::optional<Pose> RigidFromMatrix(const Eigen::Matrix3d& R, const Vec3& t) {
  if (!R.allFinite() || !t.allFinite()) return std::nullopt;
  if ((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() > kRotationTolerance ||
      R.determinant() < 0) {
    return std::nullopt;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  return Pose(lie::SO3<double>::FromMatrix(nearest), t);
}

}  // namespace sslcd
