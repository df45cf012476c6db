// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/path_variance.h"

#include <ceres/crs_matrix.h>

#include <Eigen/SparseCholesky>

#include "bundle/ba_terms.h"

namespace sslcd {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// H = J^T J over all states that are not constant, cameras first. None: a residual is not finite.
std::optional<Sparse> Hessian(const BaProblem& problem, const BaOptions& options) {
  BaTerms terms(problem, options);
  ceres::Problem::EvaluateOptions evaluate;
  evaluate.num_threads = 1;  // fixed order of sums
  evaluate.apply_loss_function = false;
  evaluate.parameter_blocks = terms.States();
  ceres::CRSMatrix rows;
  if (!terms.ceres().Evaluate(evaluate, nullptr, nullptr, nullptr, &rows)) return std::nullopt;
  const Sparse jacobian = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
      rows.num_rows, rows.num_cols, static_cast<int>(rows.values.size()), rows.rows.data(),
      rows.cols.data(), rows.values.data());
  return Sparse(jacobian.transpose() * jacobian);
}

}  // namespace

std::optional<std::vector<double>> PathVariances(const BaProblem& problem, const BaOptions& options,
                                                 const std::vector<Eigen::Matrix3Xd>& functions) {
  const std::optional<Sparse> h = Hessian(problem, options);
  if (!h) return std::nullopt;
  const Eigen::SimplicialLDLT<Sparse> hessian(*h);
  if (hessian.info() != Eigen::Success) return std::nullopt;
  std::vector<double> variances;
  for (const Eigen::Matrix3Xd& function : functions) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(hessian.rows());
    for (Eigen::Index i = 0; i < function.cols(); ++i)  // the tangent's translation is the camera's
      d.segment<3>(6 * i) =
          problem.cameras[static_cast<std::size_t>(i)].T_world_cam.so3().inverse() *
          function.col(i);
    variances.push_back(d.dot(hessian.solve(d)));
  }
  return variances;
}

}  // namespace sslcd
