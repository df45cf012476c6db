// SPDX-License-Identifier: BSD-3-Clause
#include "loop/drift.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "loop/drift_problem.h"

namespace sslcd {
namespace {

using namespace drift;  // NOLINT(google-build-using-namespace): private header
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kConverged = 1e-7;  // norm of the last step [m, rad]
// A pair is an inlier up to this whitened error. Set by hand: nearly all of a Gaussian in 3D.
constexpr double kInlierSigmas = 3.5;

/// Cauchy: weight in the normal equations of a residual with this mean square. `scale` 0: none.
double Weight(double mean_square, double scale) {
  return scale > 0 ? 1 / (1 + mean_square / (scale * scale)) : 1;
}

/// Gauss-Newton's normal equations for the perturbation [rho, phi] of D, on the right, at the
/// objects' centre.
struct NormalEquations {
  Mat6 H = Mat6::Zero();
  Vector6 b = Vector6::Zero();
  double chi2 = 0;
  int rows = 0;

  template <int N>
  void Add(const Eigen::Matrix<double, N, 6>& J, const Eigen::Matrix<double, N, 1>& r,
           double loss_scale) {
    const double weight = Weight(r.squaredNorm() / N, loss_scale);
    H += weight * J.transpose() * J;
    b += weight * J.transpose() * r;
    chi2 += weight * r.squaredNorm();
    rows += N;
  }
};

NormalEquations Linearise(const Problem& problem, const State& state, const DriftOptions& options) {
  NormalEquations equations;
  const Mat3 R = state.R.matrix();
  for (const Match& match : problem.matches) {
    const Mat3 whiten = match.sigma.cwiseInverse().asDiagonal();
    const Mat3 A = whiten * match.to_global * R;
    Eigen::Matrix<double, 3, 6> J;
    J << A, -A * Rotation::hat(Vec3(match.local - problem.centre));
    equations.Add<3>(J, whiten * PositionError(match, problem, state), problem.loss_scale);
    if (!match.has_yaw()) continue;
    const Vec3 h = Heading(match, state);
    const Vec3 u(std::cos(match.yaw_local), std::sin(match.yaw_local), 0);
    const Eigen::RowVector3d slope =
        Eigen::RowVector3d(-h.y(), h.x(), 0) / (h.head<2>().squaredNorm() * match.sigma_yaw);
    Eigen::Matrix<double, 1, 6> J_yaw;
    J_yaw << Eigen::RowVector3d::Zero(), -slope * R * Rotation::hat(u);
    equations.Add<1>(J_yaw, Eigen::Matrix<double, 1, 1>(YawError(match, state) / match.sigma_yaw),
                     problem.loss_scale);
  }
  // The vertical is kept within tilt_sigma_rad. In 4 DoF these two rows have no free column.
  const Vec3 up = R.transpose() * Vec3::UnitZ();
  Eigen::Matrix<double, 2, 6> J_tilt;
  J_tilt << Eigen::Matrix<double, 2, 3>::Zero(),
      Mat3(Rotation::hat(up)).topRows<2>() / options.tilt_sigma_rad;
  equations.Add<2>(J_tilt, up.head<2>() / options.tilt_sigma_rad, 0);
  if (!options.six_dof) {  // only the prior constrains roll and pitch
    for (const int i : {3, 4}) {
      equations.H.row(i).setZero();
      equations.H.col(i).setZero();
      equations.H(i, i) = 1 / (options.tilt_sigma_rad * options.tilt_sigma_rad);
      equations.b[i] = 0;
    }
  }
  return equations;
}

/// Transforms the centred, gravity-aligned result to the world's axes.
void Store(const Problem& problem, const State& state, const Mat6& covariance,
           const GravityFrame& gravity, DriftResult& result) {
  const Pose T_gravity_global_local(state.R, state.t - state.R * problem.centre);
  const Pose T_world_gravity(Rotation::FromMatrix(gravity.Basis()), Vec3(Vec3::Zero()));
  result.T_global_local = T_world_gravity * T_gravity_global_local * T_world_gravity.inverse();
  // from the centre's frame to the world's
  const Mat6 A = (T_world_gravity * Pose::Trans(problem.centre)).Adj();
  result.covariance = A * covariance * A.transpose();
}

bool MostHeadingsAgree(const Problem& problem, const State& state) {
  int headings = 0, agree = 0;
  for (const Match& match : problem.matches) {
    if (!match.has_yaw()) continue;
    ++headings;
    if (std::abs(YawError(match, state)) <= kInlierSigmas * match.sigma_yaw) ++agree;
  }
  return 2 * agree > headings;
}

void CountInliers(const Problem& problem, const State& state, DriftResult& result) {
  double squares = 0;
  for (const Match& match : problem.matches) {
    const Vec3 error = PositionError(match, problem, state);
    if (!(error.cwiseQuotient(match.sigma).norm() <= kInlierSigmas)) continue;
    ++result.inliers;
    squares += error.squaredNorm();
  }
  if (result.inliers > 0) result.rms_m = std::sqrt(squares / result.inliers);
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, DriftOptions& options) {
  visitor.Flag("six_dof", options.six_dof,
               "also correct roll and pitch; false: yaw and shift only");
  visitor.Real("tilt_sigma_rad", options.tilt_sigma_rad, 1e-6, 1,
               "standard deviation of the local map's vertical");
  visitor.Real("loss_scale", options.loss_scale, 0, 1e6,
               "scale of the Cauchy loss on each pair's position and heading, in sigmas; 0: none");
}

DriftPair MakeDriftPair(const LayoutObject& local, const LayoutObject& global) {
  const auto pose = [](const LayoutObject& object) {
    return Pose(Rotation::RotZ(std::isnan(object.yaw) ? 0. : object.yaw), object.position);
  };
  DriftPair pair;
  pair.T_world_local = pose(local);
  pair.T_world_global = pose(global);
  pair.symmetry =
      std::isnan(local.yaw) || std::isnan(global.yaw) ? Symmetry::kFull : local.symmetry;
  return pair;
}

DriftResult SolveDrift(const std::vector<DriftPair>& pairs, const GravityFrame& gravity,
                       const DriftOptions& options) {
  DriftResult result;
  result.reason = Check(pairs);
  if (!result.reason.empty()) return result;
  const Problem problem = MakeProblem(pairs, gravity, options.loss_scale);
  const std::optional<Start> start = FindStart(problem, kMaxDriftYawSigmaRad, result.reason);
  if (!start) return result;

  State state = start->state;
  while (result.iterations < options.max_iterations && !result.converged) {
    const NormalEquations equations = Linearise(problem, state, options);
    const Vector6 step = -equations.H.ldlt().solve(equations.b);
    ++result.iterations;
    if (!step.allFinite()) break;
    state.t += state.R * Vec3(step.head<3>());
    state.R = state.R * Rotation::Exp(step.tail<3>());
    result.converged = step.norm() < kConverged;
  }
  const NormalEquations equations = Linearise(problem, state, options);
  const Eigen::LDLT<Mat6> H(equations.H);
  const Mat6 covariance = H.solve(Mat6::Identity());
  if (!covariance.allFinite() || !H.isPositive() ||
      !(covariance(5, 5) <= std::pow(kMaxDriftYawSigmaRad, 2))) {
    result.reason = "the matched objects do not fix the yaw";
    return result;
  }
  if (!start->by_positions && !MostHeadingsAgree(problem, state)) {
    result.reason = "objects on one spot, whose headings contradict one another";
    return result;
  }
  // Scales the covariance up if the residuals exceed the sigmas.
  const double excess = equations.chi2 / std::max(1, equations.rows - 6);
  Mat6 scaled = covariance * std::max(1., excess);
  if (!options.six_dof) scaled.block<2, 2>(3, 3) = covariance.block<2, 2>(3, 3);
  Store(problem, state, scaled, gravity, result);
  CountInliers(problem, state, result);
  result.usable = true;
  return result;
}

}  // namespace sslcd
