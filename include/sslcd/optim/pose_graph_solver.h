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
int DegreesOfFreedom(PoseFreedom freedom);

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

struct PoseGraphSummary {
  bool usable = false;  ///< false: the graph is left as it was
  bool converged = false;
  bool chordal = false;  ///< the chordal start was taken
  int iterations = 0;
  /// connected parts; each keeps its first vertex where none is fixed
  int components = 0;
  double initial_chi2 = 0, final_chi2 = 0;  ///< of the given and of the returned poses
  std::string message;                      ///< one line
};

/// Log(T_from_to^-1 T_world_from^-1 T_world_to), order [translation, rotation]; e^T I e of it is
/// the edge's chi2.
Vec6 EdgeError(const PoseGraph::Edge& edge, const Pose& T_world_from, const Pose& T_world_to);

/// chi2 = sum w e^T I e over all edges; `weights` one per edge, none given: all 1.
/// Throws Error(kBadInput) where an edge names a vertex that is not there.
double Chi2(const PoseGraph& graph, const std::vector<double>& weights = {});

/// Moves the vertices to the minimum of Chi2(graph, weights). Vertices that are `fixed` stay; a
/// connected part without one keeps its first vertex. Levenberg-Marquardt on a sparse Cholesky
/// factorisation, one thread, the same bytes every time. Never throws on bad graphs: a summary that
/// is not usable says why.
PoseGraphSummary SolvePoseGraph(PoseGraph& graph, const PoseGraphOptions& options,
                                const std::vector<double>& weights = {});

}  // namespace sslcd
