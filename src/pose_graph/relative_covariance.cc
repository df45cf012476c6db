// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/relative_covariance.h"

#include <Eigen/LU>

namespace sslcd {

RelativeCovariances::RelativeCovariances(int unknowns,
                                         const std::vector<DifferenceMeasurement>& measurements)
    : unknowns_(unknowns) {
  // The first unknown is zero and has no columns.
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](int row, int column, const Mat6& block) {
    if (row == 0 || column == 0) return;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        entries.emplace_back(6 * (row - 1) + i, 6 * (column - 1) + j, block(i, j));
  };
  for (const DifferenceMeasurement& each : measurements) {
    const Mat6 information = each.covariance.inverse();
    add(each.from, each.from, information);
    add(each.to, each.to, information);
    add(each.from, each.to, -information);
    add(each.to, each.from, -information);
  }
  Eigen::SparseMatrix<double> all(6 * (unknowns_ - 1), 6 * (unknowns_ - 1));
  all.setFromTriplets(entries.begin(), entries.end());
  information_.compute(all);
}

RelativeCovariances::Mat6 RelativeCovariances::Between(int a, int b) const {
  if (a == b) return Mat6::Zero();
  Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(6 * (unknowns_ - 1), 6);
  if (a > 0) difference.middleRows<6>(6 * (a - 1)) = -Mat6::Identity();
  if (b > 0) difference.middleRows<6>(6 * (b - 1)) = Mat6::Identity();
  return difference.transpose() * information_.solve(difference);
}

}  // namespace sslcd
