// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// What a vertex may do.
enum class PoseFreedom {
  kFull,     ///< 6 DoF
  kUpright,  ///< 4 DoF: translation and yaw about `up`. Roll and pitch are known (gravity) and stay
             ///< as they are; of a measured rotation only the yaw counts
  kPlanar,   ///< 3 DoF: as kUpright, and the height stays as it is
};

/// Where the optimisation starts.
enum class PoseGraphStart {
  kAuto,     ///< from the given poses; or chordal, where these are far from the measurements and
             ///< chordal is nearer
  kGiven,    ///< from the given poses
  kChordal,  ///< rotations from the chordal relaxation (Carlone et al., ICRA 2015), then linear
             ///< translations
};

/// Pose graph optimisation, paper IV-D Eqs. 20, 21.
struct PoseGraphOptions {
  PoseFreedom freedom = PoseFreedom::kFull;
  PoseGraphStart start = PoseGraphStart::kAuto;  ///< no key: callers that know better set it
  int max_iterations = 100;                      ///< no key: of one solve
  /// no key: the solver stops when an iteration lowers chi2 by a smaller fraction
  double tolerance = 1e-6;
  GravityFrame gravity;  ///< which way is up; for kUpright and kPlanar
};
void DescribeFields(FieldVisitor& visitor, PoseGraphOptions& options);

/// Graduated non-convexity with truncated least squares (GNC-TLS; Yang et al., RA-L 2020) over the
/// loop edges. Edges that are no loops are always trusted.
struct RobustPoseGraphOptions {
  PoseGraphOptions graph;
  /// a true loop is kept with this probability: sets the chi2 limit
  double inlier_probability = 0.99;
  /// a loop that would need odometry errors this many times larger than expected is refused at
  /// first; it comes back only if the other loops lead to it
  double drift_factor = 3.;
  /// no key: factor from one weight update to the next, by which the cost turns from convex to
  /// truncated. Yang et al. 2020 use 1.4, too.
  double mu_factor = 1.4;
};
void DescribeFields(FieldVisitor& visitor, RobustPoseGraphOptions& options);

/// 6, 4 or 3.
int DegreesOfFreedom(PoseFreedom freedom);

/// What SolvePoseGraph did.
struct PoseGraphSummary {
  bool usable = false;  ///< false: the graph is unchanged
  bool converged = false;
  bool chordal = false;  ///< the chordal start was used
  int iterations = 0;
  /// number of connected components; a component without a fixed vertex keeps its first one
  int components = 0;
  double initial_chi2 = 0, final_chi2 = 0;  ///< of the given and of the returned poses
  std::string message;                      ///< one line
};

/// Log(T_from_to^-1 T_world_from^-1 T_world_to), order [translation, rotation]; e^T I e of it is
/// the edge's chi2.
Vec6 EdgeError(const PoseGraph::Edge& edge, const Pose& T_world_from, const Pose& T_world_to);

/// chi2 = sum w e^T I e over all edges; `weights` one per edge, none given: all 1.
/// Throws Error(kBadInput) if an edge has an unknown vertex.
double Chi2(const PoseGraph& graph, const std::vector<double>& weights = {});

/// Moves the vertices to the minimum of Chi2(graph, weights). `fixed` vertices stay; a connected
/// component without one keeps its first vertex. Levenberg-Marquardt with sparse Cholesky
/// factorisation on one thread, deterministic to the byte. Never throws: for a malformed graph the
/// summary is not usable and has the reason.
PoseGraphSummary SolvePoseGraph(PoseGraph& graph, const PoseGraphOptions& options,
                                const std::vector<double>& weights = {});

/// What SolveRobust did.
struct RobustPoseGraphSummary {
  /// summary of the graph with the kept loops
  PoseGraphSummary graph;
  std::vector<double> edge_weight;  ///< per edge: 1 if trusted or kept, 0 for a refused loop
  int loops_kept = 0, loops_refused = 0;
  int rounds = 0;         ///< weight updates; 0 if all loops agreed in the first solve
  double chi2_limit = 0;  ///< largest chi2 of a kept loop
};

/// Selects the consistent loops and moves the vertices to the minimum with these. Pass all loops
/// ever proposed each time: a kept loop may be refused later if others contradict it, and may
/// return. `kept_before` has, per edge, 1 for loops that the previous solve has kept and for new
/// ones, and 0 for those it has refused; the vertices must have the poses of that solve. If hardly
/// anything changes from there, that solution is returned quickly. Otherwise, or if `kept_before`
/// is empty, the start is the geometry of the trusted edges, which does not depend on false loops.
/// Never throws, like SolvePoseGraph.
RobustPoseGraphSummary SolveRobust(PoseGraph& graph, const RobustPoseGraphOptions& options,
                                   const std::vector<double>& kept_before = {});

}  // namespace sslcd
