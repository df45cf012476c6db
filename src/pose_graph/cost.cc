// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/cost.h"

#include <lie/se3.h>
#include <lie/se3_map.h>

#include <Eigen/Cholesky>

#include <cmath>

#include "pose_graph/pose_manifold.h"

namespace sslcd {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
using Matrix76 = Eigen::Matrix<double, 7, 6, Eigen::RowMajor>;

// Converts a derivative in the tangent space to the seven parameters; PlusJacobian cancels the
// factor.
void StoreAmbient(const Matrix6& J, const double* pose, double* jacobian) {
  Matrix67 minus;
  PoseManifold().MinusJacobian(pose, minus.data());
  Eigen::Map<Matrix67> ambient(jacobian);
  ambient = J.lazyProduct(minus);
}

// Information of the fixed components, larger than that of any measurement. [1/m^2, 1/rad^2]
constexpr double kCertain = 1e8;

// What rounding leaves of a matrix with kCertain in it, relative to its largest entry: some 50
// units in the last place.
constexpr double kRounding = 1e-14;

}  // namespace

PoseGraph::Edge EdgeWithin(PoseFreedom freedom, const Vec3& up, const PoseGraph::Edge& measured,
                           const Pose& T_world_from, const Pose& T_world_to) {
  PoseGraph::Edge edge = measured;
  if (freedom == PoseFreedom::kFull) return edge;
  const auto &R_from = T_world_from.so3(), &R_to = T_world_to.so3();
  // The rotation about up from the measured to the current `to` is the yaw error of the
  // measurement.
  const auto q = (R_to * (R_from * measured.T_from_to.so3()).inverse()).unit_quaternion();
  const double yaw = 2 * std::atan2(q.vec().dot(up), q.w());
  edge.T_from_to.so3() = R_from.inverse() * lie::SO3<double>::Exp(-yaw * up) * R_to;
  const Vec3 up_to = R_to.inverse() * up;
  const Eigen::Matrix3d vertical = up_to * up_to.transpose();
  edge.information.bottomRightCorner<3, 3>() += kCertain * (Eigen::Matrix3d::Identity() - vertical);
  if (freedom == PoseFreedom::kPlanar) {
    const Vec3 step = T_world_to.translation() - T_world_from.translation();
    edge.T_from_to.translation() +=
        R_from.inverse() *
        Vec3(up * up.dot(step - R_from * Vec3(measured.T_from_to.translation())));
    edge.information.topLeftCorner<3, 3>() += kCertain * vertical;
  }
  // An edge that knows next to nothing of yaw loses that in the rounding of the fixed components.
  if (Eigen::LLT<Matrix6>(edge.information).info() != Eigen::Success) {
    const double largest = edge.information.diagonal().maxCoeff();
    edge.information += kRounding * largest * Matrix6::Identity();
  }
  return edge;
}

double Chi2Of(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends,
              const std::vector<double>& weights, const std::vector<Pose>& poses) {
  double chi2 = 0;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const Vec6 error = EdgeError(graph.edges[e], poses[ends[e].first], poses[ends[e].second]);
    chi2 += weights[e] * error.dot(graph.edges[e].information * error);
  }
  return chi2;
}

EdgeLinearisation LineariseEdge(const Pose& T_to_from_measured, const Pose& T_world_from,
                                const Pose& T_world_to) {
  // e(d_to) = Log(E Exp(d_to)). A perturbation d of `from` equals -Adj(B^-1) d of `to`.
  const Pose B = T_world_from.inverse() * T_world_to;
  EdgeLinearisation edge;
  edge.error = (T_to_from_measured * B).Log();
  edge.J_to = Pose::RightJacobianInverse(edge.error);
  edge.J_from = -edge.J_to.lazyProduct(Matrix6(B.inverse().Adj()));
  return edge;
}

EdgeCost::EdgeCost(const PoseGraph::Edge& edge, const double* weight)
    : T_to_from_(edge.T_from_to.inverse()),
      sqrt_information_(Eigen::LLT<Matrix6>(edge.information).matrixU()),
      weight_(weight) {}

bool EdgeCost::Evaluate(double const* const* poses, double* residual, double** jacobians) const {
  const Pose T_world_from = lie::SE3ConstMap<double>(poses[0]),
             T_world_to = lie::SE3ConstMap<double>(poses[1]);
  const Matrix6 S = std::sqrt(*weight_) * sqrt_information_;
  Eigen::Map<Vec6> r(residual);
  if (jacobians == nullptr) {
    r = S * (T_to_from_ * (T_world_from.inverse() * T_world_to)).Log();
    return true;
  }
  const EdgeLinearisation edge = LineariseEdge(T_to_from_, T_world_from, T_world_to);
  r = S * edge.error;
  if (jacobians[0] != nullptr) StoreAmbient(S.lazyProduct(edge.J_from), poses[0], jacobians[0]);
  if (jacobians[1] != nullptr) StoreAmbient(S.lazyProduct(edge.J_to), poses[1], jacobians[1]);
  return true;
}

bool UprightManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Pose T = lie::SE3ConstMap<double>(x);
  const double yaw = delta[translations_];
  Pose moved(lie::SO3<double>::Exp(yaw * basis_.col(2)) * T.so3(), T.translation());
  for (int i = 0; i < translations_; ++i) moved.translation() += delta[i] * basis_.col(i);
  moved.normalise();
  std::copy_n(moved.data(), 7, x_plus_delta);
  return true;
}

bool UprightManifold::PlusJacobian(const double* x, double* jacobian) const {
  // Translation and yaw of the world in the pose's own tangent space: rho = R^T d, phi = R^T up
  // yaw.
  const Eigen::Matrix3d to_pose = lie::SE3ConstMap<double>(x).so3().matrix().transpose() * basis_;
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(6, TangentSize());
  directions.topLeftCorner(3, translations_) = to_pose.leftCols(translations_);
  directions.bottomRightCorner(3, 1) = to_pose.col(2);
  Matrix76 plus;
  PoseManifold().PlusJacobian(x, plus.data());
  Eigen::Map<Eigen::Matrix<double, 7, Eigen::Dynamic, Eigen::RowMajor>>(
      jacobian, 7, TangentSize()) = plus * directions;
  return true;
}

bool UprightManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const Pose Ty = lie::SE3ConstMap<double>(y), Tx = lie::SE3ConstMap<double>(x);
  const Vec3 t = basis_.transpose() * (Ty.translation() - Tx.translation());
  std::copy_n(t.data(), translations_, y_minus_x);
  y_minus_x[translations_] = (Ty.so3() * Tx.so3().inverse()).Log().dot(basis_.col(2));
  return true;
}

bool UprightManifold::MinusJacobian(const double* x, double* jacobian) const {
  const Eigen::Matrix3d to_pose = lie::SE3ConstMap<double>(x).so3().matrix().transpose() * basis_;
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(TangentSize(), 6);
  directions.topLeftCorner(translations_, 3) = to_pose.leftCols(translations_).transpose();
  directions.bottomRightCorner(1, 3) = to_pose.col(2).transpose();
  Matrix67 minus;
  PoseManifold().MinusJacobian(x, minus.data());
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>>(jacobian, TangentSize(),
                                                                        7) = directions * minus;
  return true;
}

}  // namespace sslcd
