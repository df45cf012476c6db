// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pose_graph/block_cholesky.h"

namespace sslcd {

/// A measurement of the difference x_to - x_from of two six-vectors.
struct DifferenceMeasurement {
  int from = 0, to = 0;  ///< indices of the unknowns
  Eigen::Matrix<double, 6, 6> covariance;
};

/// The covariance of the difference of any two unknowns of which only differences are measured.
///
/// The measurements are a network of matrix-valued resistors, and the covariance of x_b - x_a is
/// its effective resistance between a and b: in series covariances add up, in parallel information
/// does (Barooah and Hespanha, "Estimation on graphs from relative measurements", 2007). For poses
/// Exp(xi) T_world_v, an edge of a pose graph with the information I measures xi_to - xi_from with
/// the covariance Adj(T_world_to) I^-1 Adj(T_world_to)^T.
class RelativeCovariances {
 public:
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  using Vec6 = Eigen::Matrix<double, 6, 1>;

  /// The measurements must connect all `unknowns`, else throws Error(kNoSolution). O(unknowns)
  /// along a chain with few loops.
  RelativeCovariances(int unknowns, const std::vector<DifferenceMeasurement>& measurements);

  /// Covariance of x_b - x_a.
  Mat6 Between(int a, int b) const;
  /// Variance of w^T (x_b - x_a); a sixth of the work.
  double Variance(int a, int b, const Vec6& w) const;

 private:
  // S^T Cov(x_b - x_a) S
  template <int Columns>
  Eigen::Matrix<double, Columns, Columns> Project(int a, int b,
                                                  const Eigen::Matrix<double, 6, Columns>& S) const;

  int unknowns_;
  BlockCholesky information_;
};

}  // namespace sslcd
