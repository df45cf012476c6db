// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/pose_graph.h"

namespace SSLCD_EXPORT sslcd {

/// The degrees of freedom of a vertex.
enum class PoseFreedom {
  kFull,  ///< 6 DoF
  /// 4 DoF: translation and yaw about `up`. Roll and pitch are known (gravity) and fixed; only the
  /// yaw of a measured rotation counts
  kUpright,
  kPlanar,  ///< 3 DoF: like kUpright with fixed height
};

/// The initial values of the optimisation.
enum class PoseGraphStart {
  /// the given poses, or chordal ones if the given ones contradict the measurements and chordal
  /// ones fit better
  kAuto,
  kGiven,    ///< the given poses
  kChordal,  ///< rotations from the chordal relaxation (Carlone et al., ICRA 2015), then linear
             ///< translations
};

/// Pose graph optimisation, paper IV-D Eqs. 20, 21.
struct PoseGraphOptions {
  PoseFreedom freedom = PoseFreedom::kFull;
  /// no key: set by callers with good initial values
  PoseGraphStart start = PoseGraphStart::kAuto;
  int max_iterations = 100;  ///< no key: limit of one solve
  /// no key: the solver stops if an iteration reduces chi2 by a smaller share
  double tolerance = 1e-6;
  GravityFrame gravity;  ///< vertical of the world for kUpright and kPlanar
};
void DescribeFields(FieldVisitor& visitor, PoseGraphOptions& options);

/// Graduated non-convexity with truncated least squares (GNC-TLS; Yang et al., RA-L 2020) over the
/// loop edges. Edges that are no loops are always trusted.
struct RobustPoseGraphOptions {
  PoseGraphOptions graph;
  /// probability of keeping a true loop; determines the chi2 limit
  double inlier_probability = 0.99;
  /// a loop that requires odometry errors this many times larger than expected is refused at first;
  /// it is kept only if the solution of the other loops agrees with it
  double drift_factor = 3.;
  /// no key: factor from one weight update to the next, by which the cost changes from convex to
  /// truncated; 1.4 as in Yang et al. 2020
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
/// component without one keeps its first vertex. Gauss-Newton, and Levenberg-Marquardt where that
/// does not lead down or the freedom is not full; sparse Cholesky factorisation on one thread,
/// deterministic to the byte. For a malformed graph or weight, and where numbers overflow, the
/// summary is not usable and has the reason. Throws std::bad_alloc alone.
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
