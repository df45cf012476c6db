// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <optional>

namespace sslcd {

/// Smallest eigenvalue of a projected information matrix, relative to its largest one. Zero would
/// be the nearest matrix, but a solver takes the Cholesky factor, which needs positive eigenvalues.
/// With 1e-9 a direction without information has 3e4 times the sigma of the best known one, so that
/// any other edge outweighs it, and the solver's sums in double precision keep seven digits.
constexpr double kInformationFloor = 1e-9;

struct ProjectedInformation {
  Eigen::MatrixXd information;
  /// smallest eigenvalue before the projection, relative to the largest: 0 is semi-definite
  double least_eigenvalue = 0;
};

/// The symmetric matrix nearest to `information` in the Frobenius norm with eigenvalues >=
/// kInformationFloor times the largest one (Higham 1988, Computing a nearest symmetric positive
/// semidefinite matrix, theorem 2.1, with a floor in place of zero). Only smaller eigenvalues
/// change, and eigenvectors stay: a direction of negative information becomes one of (nearly) none.
/// Averages the two triangles first. Returns nothing if no eigenvalue is positive or if numbers are
/// not finite.
///
/// The field: g2o uses an indefinite matrix as it is, so that chi2 may fall below zero (its
/// `verifyInformationMatrices` asks for eigenvalues >= 0; RTAB-Map aborts otherwise). GTSAM and
/// Ceres' example take the Cholesky factor unchecked: it stops at the first pivot that is not
/// positive and weights the error with a part that is not factored. SE-Sync keeps one weight for
/// translation and one for rotation.
std::optional<ProjectedInformation> ProjectInformation(const Eigen::MatrixXd& information);

}  // namespace sslcd
