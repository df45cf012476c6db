// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pose_graph/pose_graph.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "pose_graph/chordal.h"
#include "pose_graph/cost.h"
#include "pose_graph/gauss_newton.h"
#include "pose_graph/index.h"
#include "pose_graph/pose_manifold.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Ends = std::vector<std::pair<int, int>>;

// Fixed vertices, and the first vertex of each component without one.
std::vector<bool> Anchors(const PoseGraph& graph, const std::vector<int>& component) {
  std::vector<bool> anchored(graph.vertices.size()), held(graph.vertices.size());
  for (std::size_t v = 0; v < anchored.size(); ++v)
    if (graph.vertices[v].fixed) anchored[v] = held[component[v]] = true;
  for (std::size_t v = 0; v < anchored.size(); ++v)
    if (!held[component[v]]) anchored[v] = held[component[v]] = true;
  return anchored;
}

// A chordal start pays where the poses are this much further from the measurements than noise
// explains (times the expected chi-square), or where one of them is turned this far [rad]: beyond,
// a linearised rotation leads astray. Set by hand.
constexpr double kFarFromMeasurements = 10, kFarTurned = 0.5;

bool IsFar(double chi2, const PoseGraph& graph, const Ends& ends,
           const std::vector<double>& weights, const std::vector<Pose>& poses) {
  if (chi2 > kFarFromMeasurements * 6 * static_cast<double>(graph.edges.size())) return true;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const Vec6 error = EdgeError(graph.edges[e], poses[ends[e].first], poses[ends[e].second]);
    if (weights[e] > 0 && error.tail<3>().norm() > kFarTurned) return true;
  }
  return false;
}

ceres::Solver::Options CeresOptions(const PoseGraphOptions& options) {
  ceres::Solver::Options ceres_options;
  ceres_options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  ceres_options.max_num_iterations = options.max_iterations;
  ceres_options.function_tolerance = options.tolerance;
  ceres_options.logging_type = ceres::SILENT;
  ceres_options.num_threads = 1;
  ceres_options.initial_trust_region_radius = 1e10;  // the first step is a Gauss-Newton step
  return ceres_options;
}

// Returns the graph's poses, or those of the chordal relaxation if it is requested, or if the
// graph's poses are far from the measurements and it is closer. Sets the kind of start in the
// summary.
std::vector<Pose> StartPoses(const PoseGraph& graph, const Ends& ends,
                             const std::vector<double>& weights, const std::vector<bool>& anchored,
                             const PoseGraphOptions& options, PoseGraphSummary& summary) {
  std::vector<Pose> poses = PosesOf(graph);
  summary.initial_chi2 = Chi2Of(graph, ends, weights, poses);
  const bool asked = options.start == PoseGraphStart::kChordal;
  const bool try_chordal =
      asked || (options.start == PoseGraphStart::kAuto && options.freedom == PoseFreedom::kFull &&
                IsFar(summary.initial_chi2, graph, ends, weights, poses));
  if (!try_chordal) return poses;
  const auto chordal = ChordalStart(graph, ends, weights, anchored);
  summary.chordal =
      chordal && (asked || Chi2Of(graph, ends, weights, *chordal) < summary.initial_chi2);
  return summary.chordal ? *chordal : poses;
}

// argmin over `poses` of chi2, by Levenberg-Marquardt.
ceres::Solver::Summary MinimiseWithCeres(const PoseGraphProblem& minimised,
                                         const PoseGraphOptions& options,
                                         std::vector<Pose>& poses) {
  const auto& [graph, ends, weights, anchored] = minimised;
  PoseManifold full;
  UprightManifold upright(options.gravity, options.freedom == PoseFreedom::kPlanar);
  ceres::Manifold* manifold = &full;
  if (options.freedom != PoseFreedom::kFull) manifold = &upright;
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  for (std::size_t v = 0; v < poses.size(); ++v) {
    problem.AddParameterBlock(poses[v].data(), 7, manifold);
    if (anchored[v]) problem.SetParameterBlockConstant(poses[v].data());
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (weights[e] == 0) continue;
    Pose& from = poses[ends[e].first];
    Pose& to = poses[ends[e].second];
    const PoseGraph::Edge edge =
        EdgeWithin(options.freedom, options.gravity.up, graph.edges[e], from, to);
    problem.AddResidualBlock(new EdgeCost(edge, &weights[e]), nullptr, from.data(), to.data());
  }
  ceres::Solver::Summary result;
  ceres::Solve(CeresOptions(options), &problem, &result);
  return result;
}

// Ceres only says "non-numeric causes" where CHOLMOD had no memory, or a matrix too large for it.
std::string MessageOf(const ceres::Solver::Summary& result) {
  for (const char* cause : {"non-numeric causes", "Out of memory"})
    if (result.message.find(cause) != std::string::npos)
      return "memory is short, or the graph is too large for the linear solver (" +
             result.message.substr(0, result.message.find_last_not_of(". \n") + 1) + ")";
  return result.message;
}

// Moves `poses` to the minimum of chi2. Most graphs start near it, where Gauss-Newton gets there in
// a fraction of the time; damped steps go on where it does not.
void Minimise(const PoseGraphProblem& problem, const PoseGraphOptions& options,
              std::vector<Pose>& poses, PoseGraphSummary& summary) {
  if (options.freedom == PoseFreedom::kFull) {
    const GaussNewtonSummary direct = GaussNewton(problem, options, poses);
    summary.iterations = direct.steps;
    if (direct.end != GaussNewtonEnd::kStuck) {
      summary.usable = true;
      summary.converged = direct.end == GaussNewtonEnd::kConverged;
      summary.message = summary.converged ? "Gauss-Newton has converged" : "too many iterations";
      return;
    }
  }
  const ceres::Solver::Summary result = MinimiseWithCeres(problem, options, poses);
  summary.usable = result.IsSolutionUsable();
  summary.converged = result.termination_type == ceres::CONVERGENCE ||
                      result.termination_type == ceres::USER_SUCCESS;
  summary.iterations += static_cast<int>(result.iterations.size()) - 1;
  summary.message = MessageOf(result);
}

}  // namespace

int DegreesOfFreedom(PoseFreedom freedom) {
  return freedom == PoseFreedom::kFull ? 6 : freedom == PoseFreedom::kUpright ? 4 : 3;
}

void DescribeFields(FieldVisitor& visitor, PoseGraphOptions& options) {
  visitor.Enum("freedom", options.freedom, {"full", "upright", "planar"},
               "freedom of a pose; full: 6 DoF; upright: translation and yaw; planar: horizontal "
               "translation and yaw");
}

Vec6 EdgeError(const PoseGraph::Edge& edge, const Pose& T_world_from, const Pose& T_world_to) {
  return (edge.T_from_to.inverse() * (T_world_from.inverse() * T_world_to)).Log();
}

double Chi2(const PoseGraph& graph, const std::vector<double>& weights) {
  const PoseGraphIndex index = IndexPoseGraph(graph);
  if (!index.trouble.empty()) throw Error(ErrorKind::kBadInput, "pose graph: " + index.trouble);
  return Chi2Of(graph, index.ends,
                weights.empty() ? std::vector<double>(graph.edges.size(), 1.) : weights,
                PosesOf(graph));
}

PoseGraphSummary SolvePoseGraph(PoseGraph& graph, const PoseGraphOptions& options,
                                const std::vector<double>& given_weights) {
  PoseGraphSummary summary;
  const PoseGraphIndex index = IndexPoseGraph(graph);
  if (!index.trouble.empty() || graph.edges.empty()) {
    summary.message =
        index.trouble.empty() ? "nothing to optimise: no edges" : "not optimised: " + index.trouble;
    return summary;
  }
  std::vector<double> weights = given_weights;
  weights.resize(graph.edges.size(), 1.);
  if (!std::all_of(weights.begin(), weights.end(),
                   [](double weight) { return weight >= 0 && std::isfinite(weight); })) {
    summary.message = "not optimised: a weight is negative or no number";
    return summary;
  }
  std::vector<bool> use;
  for (const double weight : weights) use.push_back(weight > 0);
  const std::vector<int> component =
      Components(static_cast<int>(graph.vertices.size()), index.ends, use);
  summary.components = 1 + *std::max_element(component.begin(), component.end());
  const std::vector<bool> anchored = Anchors(graph, component);
  std::vector<Pose> poses = StartPoses(graph, index.ends, weights, anchored, options, summary);
  if (!std::isfinite(summary.initial_chi2)) {
    summary.message = "not optimised: poses or measurements are too far apart, chi2 overflows";
    return summary;
  }
  Minimise({graph, index.ends, weights, anchored}, options, poses, summary);
  if (!summary.usable) return summary;
  for (std::size_t v = 0; v < poses.size(); ++v) graph.vertices[v].T_world_vertex = poses[v];
  summary.final_chi2 = Chi2Of(graph, index.ends, weights, poses);
  return summary;
}

}  // namespace sslcd
