// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"

#include <limits>
#include <optional>

#include "sslcd/core/error.h"

namespace sslcd::python {

Array ToArray(const Pose& pose) { return ToArray(pose.matrix()); }

Array ToArray(const std::vector<Pose>& poses) {
  return Stack<4, 4>(poses, [](const Pose& pose) { return pose.matrix(); });
}

Pose PoseFrom(const double* matrix, const std::string& name) {
  using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor | Eigen::DontAlign>;
  const Matrix4 T = Eigen::Map<const Matrix4>(matrix);
  if (!T.allFinite()) return Pose::Trans(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  const std::optional<Pose> pose =
      T.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1))
          ? RigidFromMatrix(T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>())
          : std::nullopt;
  if (!pose)
    throw Error(ErrorKind::kBadInput,
                name + " is no rigid transform [R t; 0 0 0 1] with a rotation R");
  return *pose;
}

std::vector<Pose> PosesFrom(const Array& matrices, const std::string& name) {
  std::vector<Pose> poses;
  for (py::ssize_t i = 0; i < matrices.shape(0); ++i)
    poses.push_back(PoseFrom(matrices.data(i, 0, 0), name + "[" + std::to_string(i) + "]"));
  return poses;
}

Vec3 VectorFrom(const Array& values) { return {values.at(0), values.at(1), values.at(2)}; }

}  // namespace sslcd::python
