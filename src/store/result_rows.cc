// SPDX-License-Identifier: BSD-3-Clause
#include "store/result_rows.h"

#include <cmath>

#include "store/bytes.h"

namespace sslcd {

void BindPose(Statement& statement, const Pose& pose) {
  for (int i = 0; i < Pose::kParameters; ++i) statement.Bind(pose.data()[i]);
}

Pose PoseAt(const Statement& row, int column) {
  Pose pose;
  for (int i = 0; i < Pose::kParameters; ++i) pose.data()[i] = row.Finite(column + i);
  const double norm = Eigen::Map<const Eigen::Vector4d>(pose.data()).norm();
  if (!(std::abs(norm - 1) <= kRotationTolerance))
    row.Refuse("a quaternion of length " + std::to_string(norm));
  return pose;
}

std::string TriangleBytes(const SymmetricMatrix6& matrix) {
  ByteWriter bytes;
  for (int i = 0; i < 6; ++i)
    for (int k = i; k < 6; ++k) bytes.Real(matrix(i, k));
  return bytes.Take();
}

SymmetricMatrix6 MatrixOf(const std::string& text) {
  ByteReader bytes(text);
  SymmetricMatrix6 matrix;
  for (int i = 0; i < 6; ++i)
    for (int k = i; k < 6; ++k) matrix(i, k) = matrix(k, i) = bytes.Real();
  return matrix;
}

}  // namespace sslcd
