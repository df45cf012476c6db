// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/pose.h"
#include "store/database.h"

namespace sslcd {

using SymmetricMatrix6 = Eigen::Matrix<double, 6, 6, Eigen::DontAlign>;

/// Binds, and reads from a column on, the seven numbers of a pose.
void BindPose(Statement& statement, const Pose& pose);
Pose PoseAt(const Statement& row, int column);

/// The upper triangle of a symmetric matrix, row by row, as 21 doubles.
std::string TriangleBytes(const SymmetricMatrix6& matrix);
SymmetricMatrix6 MatrixOf(const std::string& bytes);

}  // namespace sslcd
