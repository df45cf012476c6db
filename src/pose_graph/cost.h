// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <utility>
#include <vector>

#include "sslcd/core/pose_graph.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {

/// Restricts an edge to the degrees of freedom of its vertices. The fixed components (roll, pitch,
/// and height if planar) come from the poses of its ends with a high information; the measurement
/// keeps yaw and translation. Its information stays positive definite. kFull: the edge itself.
PoseGraph::Edge EdgeWithin(PoseFreedom freedom, const Vec3& up, const PoseGraph::Edge& edge,
                           const Pose& T_world_from, const Pose& T_world_to);

/// sum_e weights_e e^T I_e e over the edges, e = EdgeError(). `ends` as in PoseGraphIndex.
double Chi2Of(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends,
              const std::vector<double>& weights, const std::vector<Pose>& poses);

/// EdgeError() and its derivatives for T_world_from Exp(d_from) and T_world_to Exp(d_to).
struct EdgeLinearisation {
  Vec6 error;
  Eigen::Matrix<double, 6, 6> J_from, J_to;
};
EdgeLinearisation LineariseEdge(const Pose& T_to_from_measured, const Pose& T_world_from,
                                const Pose& T_world_to);

/// One edge: r = sqrt(weight) L^T Log(T_from_to^-1 T_world_from^-1 T_world_to) with information = L
/// L^T, so that |r|^2 = weight e^T I e. Both parameter blocks are poses [qx qy qz qw tx ty tz];
/// with analytic derivatives, whose product with PoseManifold's PlusJacobian is the derivative in
/// its tangent space.
class EdgeCost final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  /// `weight` is read at each evaluation and must outlive the cost.
  EdgeCost(const PoseGraph::Edge& edge, const double* weight);
  bool Evaluate(double const* const* poses, double* residual, double** jacobians) const override;

 private:
  Pose T_to_from_;  // measured
  Eigen::Matrix<double, 6, 6> sqrt_information_;
  const double* weight_;
};

/// Poses with fixed roll and pitch. Tangent [translation in the world, yaw about up]: three
/// translations, or two (horizontal) when planar.
class UprightManifold final : public ceres::Manifold {
 public:
  UprightManifold(const GravityFrame& gravity, bool planar)
      : basis_(gravity.Basis()), translations_(planar ? 2 : 3) {}
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return translations_ + 1; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;

 private:
  Eigen::Matrix3d basis_;  // columns forward, left, up
  int translations_;
};

}  // namespace sslcd
