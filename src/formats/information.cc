// SPDX-License-Identifier: BSD-3-Clause
#include "formats/information.h"

#include <Eigen/Eigenvalues>

namespace sslcd {

std::optional<ProjectedInformation> ProjectInformation(const Eigen::MatrixXd& information) {
  // A scale of one keeps sums and products of extreme numbers finite.
  const double scale = information.cwiseAbs().maxCoeff();
  if (!(scale > 0) || !information.allFinite()) return std::nullopt;
  const Eigen::MatrixXd scaled = information / scale;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (scaled + scaled.transpose()));
  const Eigen::VectorXd& values = eigen.eigenvalues();  // ascending
  const double largest = values[values.size() - 1];
  if (eigen.info() != Eigen::Success || !(largest > 0)) return std::nullopt;
  const Eigen::MatrixXd& vectors = eigen.eigenvectors();
  const Eigen::MatrixXd raised =
      vectors * values.cwiseMax(kInformationFloor * largest).asDiagonal() * vectors.transpose();
  return ProjectedInformation{scale * 0.5 * (raised + raised.transpose()), values[0] / largest};
}

}  // namespace sslcd
