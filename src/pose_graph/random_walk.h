// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <vector>

namespace sslcd {

/// A measured difference between two points of a walk: x_to - x_from. It may be wrong.
struct WalkDifference {
  int from = 0, to = 0;
  double value = 0, sigma = 1;
};

/// A random walk along a path with measured differences, estimated with its rate w:
///   x_0 = 0,  x_k+1 - x_k ~ N(0, w^2 s_k),  measured ~ x_to - x_from + sigma t_4.
/// w maximises the marginal likelihood of the measurements. The Student-t distribution of four
/// degrees of freedom is a normal one with weights, which are found with w rising from zero: what a
/// stiff walk takes for wrong has to be worth a faster one.
class RandomWalk {
 public:
  /// `lengths` are the s_k between successive points, positive; any unit of path. Infinite where
  /// the walk starts again anywhere.
  RandomWalk(const std::vector<double>& lengths, std::vector<WalkDifference> measured);

  /// x_k of all points; zero without measurements.
  const Eigen::VectorXd& mean() const { return mean_; }
  double rate() const { return rate_; }
  /// Variance of sum_k d_k x_k.
  double VarianceAlong(const Eigen::VectorXd& direction) const;

 private:
  void Solve(double rate);
  void UpdateWeights();
  double Cost(double rate) const;

  Eigen::VectorXd lengths_;
  std::vector<WalkDifference> measured_;
  Eigen::VectorXd weights_;  // of the measurements
  Eigen::VectorXd mean_;
  double rate_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> information_;  // of x_1, x_2, ...
};

}  // namespace sslcd
