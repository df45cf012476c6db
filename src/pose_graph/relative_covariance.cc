// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/relative_covariance.h"

#include <Eigen/LU>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::vector<std::pair<int, int>> PairsOf(const std::vector<DifferenceMeasurement>& measurements) {
  std::vector<std::pair<int, int>> pairs;
  for (const DifferenceMeasurement& each : measurements)
    if (each.from > 0 && each.to > 0) pairs.push_back({each.from - 1, each.to - 1});
  return pairs;
}

}  // namespace

// The first unknown is zero and has no place in the equations.
RelativeCovariances::RelativeCovariances(int unknowns,
                                         const std::vector<DifferenceMeasurement>& measurements)
    : unknowns_(unknowns), information_(unknowns - 1, PairsOf(measurements)) {
  for (const DifferenceMeasurement& each : measurements) {
    const Mat6 information = each.covariance.inverse();
    if (each.from > 0) information_.Add(each.from - 1, each.from - 1, information);
    if (each.to > 0) information_.Add(each.to - 1, each.to - 1, information);
    if (each.from > 0 && each.to > 0) information_.Add(each.from - 1, each.to - 1, -information);
  }
  if (!information_.Factorise())
    throw Error(ErrorKind::kNoSolution,
                "relative covariances: a covariance is not positive "
                "definite, or an unknown is not connected");
}

template <int Columns>
Eigen::Matrix<double, Columns, Columns> RelativeCovariances::Project(
    int a, int b, const Eigen::Matrix<double, 6, Columns>& S) const {
  using Block = Eigen::Matrix<double, 6, Columns>;
  if (a == b) return Eigen::Matrix<double, Columns, Columns>::Zero();
  BlockCholesky::Vector<Columns> difference(unknowns_ - 1, Block::Zero());
  if (a > 0) difference[a - 1] = -S;
  if (b > 0) difference[b - 1] = S;
  const BlockCholesky::Vector<Columns> x = information_.Solve(difference);
  const Block zero = Block::Zero();
  return S.transpose() * ((b > 0 ? x[b - 1] : zero) - (a > 0 ? x[a - 1] : zero));
}

RelativeCovariances::Mat6 RelativeCovariances::Between(int a, int b) const {
  return Project<6>(a, b, Mat6::Identity());
}

double RelativeCovariances::Variance(int a, int b, const Vec6& w) const {
  return Project<1>(a, b, w)(0);
}

}  // namespace sslcd
