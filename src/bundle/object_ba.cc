// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/object_ba.h"

#include <ceres/solver.h>

#include <algorithm>
#include <cmath>

#include "bundle/ba_terms.h"
#include "bundle/cost_functors.h"
#include "core/median.h"

namespace sslcd {
namespace {

ceres::Solver::Options SolverOptions(const BaOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // Eigen's sparse Cholesky: SuiteSparse is not faster for such small blocks and may start threads.
  solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  solver.max_num_iterations = options.max_iterations;
  solver.num_threads =
      1;  // fixed order of sums, so that results do not depend on the number of cores
  solver.logging_type = ceres::SILENT;
  // steps with a smaller gain do not change the states relevantly
  solver.function_tolerance = 1e-5;
  // weak modes (bending of a long chain) need many steps with more damping
  solver.initial_trust_region_radius = 1e6;
  // Gauss-Newton is Levenberg-Marquardt without damping.
  if (options.solver == BaOptions::Solver::kGaussNewton) {
    solver.initial_trust_region_radius = 1e32;
    solver.max_trust_region_radius = 1e33;
    solver.min_lm_diagonal = 1e-32;
    solver.max_lm_diagonal = 1e-31;
  }
  return solver;
}

bool Finite(const BaProblem& problem) {
  const auto finite = [](const Pose& T) { return std::isfinite(T.Log().sum()); };
  for (const BaCamera& camera : problem.cameras)
    if (!finite(camera.T_world_cam)) return false;
  for (const BaObject& object : problem.objects)
    if (!std::isfinite(object.pose.position.sum() + object.pose.yaw)) return false;
  for (const BaSighting& sighting : problem.sightings)
    if (!finite(sighting.T_cam_object)) return false;
  for (const BaOdometry& edge : problem.odometry)
    if (!finite(edge.T_from_to)) return false;
  for (const BaTie& tie : problem.ties)
    if (!finite(tie.pose.T_a_b) || !tie.pose.covariance.allFinite()) return false;
  return std::isfinite(problem.log_scale);
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, BaOptions& options) {
  visitor.Enum("residual", options.residual, {"robust", "paper"},
               "robust: whitened and modulo an object's symmetry; paper: Eq. 8 as printed");
  visitor.Enum("solver", options.solver, {"levenberg_marquardt", "gauss_newton"},
               "levenberg_marquardt, or the paper's gauss_newton, without damping");
  visitor.Integer("max_iterations", options.max_iterations, 1, 1000,
                  "most iterations of one bundle adjustment");
  visitor.Real("loss_scale", options.loss_scale, 0, 1e6,
               "robust: scale of the Cauchy loss on a sighting, in sigmas; 0: none");
  visitor.Real("correlation", options.correlation, 1, 100,
               "robust: factor on the detector's sigmas, because errors of successive frames are "
               "correlated");
  visitor.Nested("odometry", options.odometry, "errors of odometry between two keyframes");
}

BaSummary SolveBa(BaProblem& problem, const BaOptions& options) {
  BaSummary summary;
  if (problem.cameras.empty() || (problem.sightings.empty() && problem.ties.empty())) {
    summary.message = "nothing to optimise: no sightings and no ties";
    return summary;
  }
  if (!Finite(problem)) {
    summary.message = "not optimised: the input holds NaN or infinite values";
    return summary;
  }
  BaTerms terms(problem, options);
  ceres::Solver::Summary result;
  ceres::Solve(SolverOptions(options), &terms.ceres(), &result);
  summary.usable = result.IsSolutionUsable();
  summary.converged = result.termination_type == ceres::CONVERGENCE;
  summary.iterations = static_cast<int>(result.iterations.size());
  summary.initial_cost = result.initial_cost;
  summary.final_cost = result.final_cost;
  summary.message = result.message;
  if (summary.usable) terms.Store(problem);
  return summary;
}

NoiseScale EstimateNoiseScale(const BaProblem& problem) {
  constexpr double kMedianOfGaussian = 0.6745;          // median of |x|, x ~ N(0, 1)
  constexpr std::size_t kFewest = 20;                   // smallest number of errors of a median
  constexpr double kLeastScale = 0.5, kMostScale = 40;  // sanity bounds, as ObjectMap has them
  std::vector<double> errors[4];
  for (const BaSighting& sighting : problem.sightings) {
    const BaObject& object = problem.objects[sighting.object];
    const Pose& T_world_cam = problem.cameras[sighting.camera].T_world_cam;
    const Vec3 expected = T_world_cam.inverse() * object.pose.position;
    const double period = object.symmetry == Symmetry::kFull ? 0. : M_PI;
    const ObjectResidual residual{sighting.T_cam_object, expected,
                                  SigmasAt(expected.norm(), problem.noise, NoiseScale::Uniform(1.)),
                                  period, problem.gravity};
    const Vec3& p = object.pose.position;
    const double state[4] = {p.x(), p.y(), p.z(), object.pose.yaw};
    double r[4];
    residual(T_world_cam.data(), state, r);
    for (int i = 0; i < (period > 0 ? 4 : 3); ++i) errors[i].push_back(std::abs(r[i]));
  }
  NoiseScale scale = problem.noise_scale;
  double* const components[4] = {&scale.radial, &scale.lateral, &scale.vertical, &scale.yaw};
  for (int i = 0; i < 4; ++i)
    if (errors[i].size() >= kFewest)
      *components[i] = std::clamp(Median(errors[i]) / kMedianOfGaussian, kLeastScale, kMostScale);
  return scale;
}

}  // namespace sslcd
