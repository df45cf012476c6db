// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/marginal_prior.h"

#include <lie/se3_map.h>

#include <ceres/crs_matrix.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>
#include <set>

#include "bundle/ba_terms.h"
#include "pose_graph/pose_manifold.h"

namespace sslcd {
namespace {
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
}  // namespace

MarginalPriorCost::MarginalPriorCost(const BaPrior& prior) : prior_(prior) {
  for (std::size_t i = 0; i < prior.cameras.size(); ++i)
    mutable_parameter_block_sizes()->push_back(7);
  for (std::size_t k = 0; k < prior.objects.size(); ++k)
    mutable_parameter_block_sizes()->push_back(4);
  mutable_parameter_block_sizes()->push_back(1);
  set_num_residuals(static_cast<int>(prior.J.rows()));
}

bool MarginalPriorCost::Evaluate(double const* const* blocks, double* residuals,
                                 double** jacobians) const {
  const int cameras = static_cast<int>(prior_.cameras.size()),
            objects = static_cast<int>(prior_.objects.size());
  const int rows = static_cast<int>(prior_.J.rows());
  Eigen::VectorXd difference(prior_.J.cols());
  int column = 0;
  for (int i = 0; i < cameras; ++i, column += 6) {
    const Pose T = lie::SE3Map<const double>(blocks[i]);
    const Vec6 log = (prior_.cameras[i].inverse() * T).Log();
    difference.segment<6>(column) = log;
    if (jacobians == nullptr || jacobians[i] == nullptr) continue;
    Eigen::Matrix<double, 6, 7, Eigen::RowMajor> to_tangent;
    PoseManifold().MinusJacobian(blocks[i], to_tangent.data());
    Eigen::Map<RowMajor>(jacobians[i], rows, 7) =
        prior_.J.middleCols<6>(column) * Pose::RightJacobianInverse(log) * to_tangent;
  }
  for (int k = 0; k < objects; ++k, column += 4) {
    const double* x = blocks[cameras + k];
    const UprightPose& x0 = prior_.objects[k];
    difference.segment<3>(column) = Vec3(x[0], x[1], x[2]) - x0.position;
    difference[column + 3] = WrapAngle(x[3] - x0.yaw);
    if (jacobians != nullptr && jacobians[cameras + k] != nullptr)
      Eigen::Map<RowMajor>(jacobians[cameras + k], rows, 4) = prior_.J.middleCols<4>(column);
  }
  difference[column] = *blocks[cameras + objects] - prior_.log_scale;
  if (jacobians != nullptr && jacobians[cameras + objects] != nullptr)
    Eigen::Map<Eigen::VectorXd>(jacobians[cameras + objects], rows) = prior_.J.col(column);
  Eigen::Map<Eigen::VectorXd>(residuals, rows) = prior_.r0 + prior_.J * difference;
  return true;
}

namespace {

// Eigenvalues below these shares of the largest one count as zero, since the data do not determine
// their directions. First for the dropped states, then for the prior, which adds rounding errors.
constexpr double kFreeOfDropped = 1e-12, kFreeOfPrior = 1e-10;
constexpr double kLeastEigenvalue = 1e-12;  // of the largest one, without any data

double LargestOf(const Eigen::VectorXd& eigenvalues) {
  return std::max(kLeastEigenvalue, eigenvalues.cwiseAbs().maxCoeff());
}

// 0.5 x^T H x + b^T x, over states in the order of `names`.
struct Quadratic {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
};

// Eliminates the first `dropped` states: Schur complement, with a pseudo-inverse because the data
// may leave some free.
Quadratic Eliminate(const Quadratic& q, int dropped) {
  const int kept = static_cast<int>(q.H.rows()) - dropped;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(q.H.topLeftCorner(dropped, dropped));
  const double floor = kFreeOfDropped * LargestOf(eigen.eigenvalues());
  const Eigen::VectorXd inverse =
      eigen.eigenvalues().unaryExpr([floor](double v) { return v > floor ? 1. / v : 0.; });
  const Eigen::MatrixXd H_inverse =
      eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  const Eigen::MatrixXd coupling = q.H.bottomLeftCorner(kept, dropped) * H_inverse;
  return {q.H.bottomRightCorner(kept, kept) - coupling * q.H.topRightCorner(dropped, kept),
          q.b.tail(kept) - coupling * q.b.head(dropped)};
}

// H = J^T J and b = J^T r0.
void SquareRoot(const Quadratic& q, BaPrior& prior) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (q.H + q.H.transpose()));
  const double floor = kFreeOfPrior * LargestOf(eigen.eigenvalues());
  const Eigen::VectorXd root =
      eigen.eigenvalues().unaryExpr([floor](double v) { return v > floor ? std::sqrt(v) : 0.; });
  const Eigen::VectorXd inverse_root = root.unaryExpr([](double v) { return v > 0 ? 1. / v : 0.; });
  prior.J = root.asDiagonal() * eigen.eigenvectors().transpose();
  prior.r0 = inverse_root.asDiagonal() * eigen.eigenvectors().transpose() * q.b;
}

// Indices of the dropped states.
struct Dropped {
  std::set<int> cameras, objects;
};

// The states of a prior in the order of the columns of the Jacobian: dropped states, remaining
// cameras and objects, scale.
struct States {
  std::vector<double*> blocks;
  int dropped_columns = 0;          // columns of the dropped states
  std::vector<int> object_columns;  // of each remaining object: 3 without yaw
};

int ColumnsOf(const BaObject& object) { return object.symmetry == Symmetry::kFull ? 3 : 4; }

// Residuals of dropped states, the scale's prior, and the prior of an earlier marginalisation, in
// the order of their addition, so that the sums below are deterministic.
std::vector<ceres::ResidualBlockId> SelectResiduals(BaTerms& terms, const Dropped& dropped) {
  std::set<double*> gone;
  for (const int i : dropped.cameras) gone.insert(terms.camera(i));
  for (const int k : dropped.objects) gone.insert(terms.object(k));
  std::vector<ceres::ResidualBlockId> selected;
  terms.ceres().GetResidualBlocks(&selected);
  const auto stays = [&](ceres::ResidualBlockId id) {
    std::vector<double*> blocks;
    terms.ceres().GetParameterBlocksForResidualBlock(id, &blocks);
    const bool scale_only = blocks.size() == 1 && blocks[0] == terms.log_scale();
    const bool is_prior = dynamic_cast<const MarginalPriorCost*>(
                              terms.ceres().GetCostFunctionForResidualBlock(id)) != nullptr;
    return !scale_only && !is_prior &&
           std::none_of(blocks.begin(), blocks.end(), [&](double* b) { return gone.count(b) > 0; });
  };
  selected.erase(std::remove_if(selected.begin(), selected.end(), stays), selected.end());
  return selected;
}

// Lists the states of the residuals, and enters the remaining ones into `prior`.
States OrderStates(BaTerms& terms, const BaProblem& problem,
                   const std::vector<ceres::ResidualBlockId>& residuals, const Dropped& dropped,
                   BaPrior& prior) {
  std::set<double*> touched;
  for (const ceres::ResidualBlockId id : residuals) {
    std::vector<double*> blocks;
    terms.ceres().GetParameterBlocksForResidualBlock(id, &blocks);
    touched.insert(blocks.begin(), blocks.end());
  }
  States states;
  for (const int i : dropped.cameras) {
    states.blocks.push_back(terms.camera(i));
    states.dropped_columns += 6;
  }
  for (const int k : dropped.objects) {
    states.blocks.push_back(terms.object(k));
    states.dropped_columns += ColumnsOf(problem.objects[k]);
  }
  for (std::size_t i = 0; i < problem.cameras.size(); ++i) {
    if (dropped.cameras.count(i) || !touched.count(terms.camera(i))) continue;
    states.blocks.push_back(terms.camera(i));
    prior.frames.push_back(problem.cameras[i].frame);
    prior.cameras.push_back(problem.cameras[i].T_world_cam);
  }
  for (std::size_t k = 0; k < problem.objects.size(); ++k) {
    if (dropped.objects.count(k) || !touched.count(terms.object(k))) continue;
    states.blocks.push_back(terms.object(k));
    states.object_columns.push_back(ColumnsOf(problem.objects[k]));
    prior.object_ids.push_back(problem.objects[k].id);
    prior.objects.push_back(problem.objects[k].pose);
  }
  states.blocks.push_back(terms.log_scale());
  prior.log_scale = problem.log_scale;
  return states;
}

// Gauss-Newton: H = J^T J, b = J^T r at the current states; none if a residual cannot be evaluated.
std::optional<Quadratic> Linearise(BaTerms& terms, const std::vector<double*>& blocks,
                                   const std::vector<ceres::ResidualBlockId>& residuals) {
  ceres::Problem::EvaluateOptions evaluate;
  evaluate.parameter_blocks = blocks;
  evaluate.residual_blocks = residuals;
  std::vector<double> r;
  ceres::CRSMatrix sparse;
  if (!terms.ceres().Evaluate(evaluate, nullptr, &r, nullptr, &sparse)) return std::nullopt;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row)
    for (int at = sparse.rows[row]; at < sparse.rows[row + 1]; ++at)
      J(row, sparse.cols[at]) = sparse.values[at];
  const Eigen::Map<const Eigen::VectorXd> residual(r.data(), r.size());
  return Quadratic{J.transpose() * J, J.transpose() * residual};
}

// Objects without yaw have three columns; adds the fourth column of BaPrior's layout with zeros.
void FillYawColumns(const std::vector<int>& object_columns, BaPrior& prior) {
  Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(
      prior.J.rows(), 6 * prior.cameras.size() + 4 * prior.objects.size() + 1);
  int from = 0, to = 0;
  const auto copy = [&](int columns, int room) {
    wide.middleCols(to, columns) = prior.J.middleCols(from, columns);
    from += columns;
    to += room;
  };
  for (std::size_t i = 0; i < prior.cameras.size(); ++i) copy(6, 6);
  for (const int columns : object_columns) copy(columns, 4);
  if (from < prior.J.cols()) copy(1, 1);  // the scale; absent where it is held constant
  prior.J = wide;
}

}  // namespace

BaPrior Marginalise(const BaProblem& problem, const std::vector<int>& cameras,
                    const std::vector<int>& objects, const BaOptions& options) {
  const Dropped dropped{{cameras.begin(), cameras.end()}, {objects.begin(), objects.end()}};
  BaTerms terms(problem, options);
  const std::vector<ceres::ResidualBlockId> residuals = SelectResiduals(terms, dropped);
  BaPrior prior;
  const States states = OrderStates(terms, problem, residuals, dropped, prior);
  const std::optional<Quadratic> cost = Linearise(terms, states.blocks, residuals);
  if (!cost) return {};
  SquareRoot(Eliminate(*cost, states.dropped_columns), prior);
  FillYawColumns(states.object_columns, prior);
  return prior;
}

}  // namespace sslcd
