// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/optim/pose_graph_solver.h"

namespace sslcd {

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

struct RobustPoseGraphSummary {
  /// chi2, of the given and of the returned poses, counts the kept loops only
  PoseGraphSummary graph;
  std::vector<double> edge_weight;  ///< per edge: 1 trusted or kept, 0 loop refused
  int loops_kept = 0, loops_refused = 0;
  int rounds = 0;         ///< weight updates; 0 where all loops agreed at once
  double chi2_limit = 0;  ///< a loop is kept if its chi2 is at most this
};

/// Decides which loops to believe and moves the vertices to the minimum with those. Hand in all
/// loops ever proposed each time; a loop kept before may be refused once others contradict it, and
/// come back. `kept_before`: per edge, 1 for loops that a former solve has kept and for new ones, 0
/// for those it has refused; the vertices are where that solve has left them. If next to nothing
/// changes from there, that is the answer, and a cheap one. Otherwise, or if it is empty, the start
/// is the trusted edges' own geometry, which false loops cannot spoil. Never throws, as
/// SolvePoseGraph.
RobustPoseGraphSummary SolveRobust(PoseGraph& graph, const RobustPoseGraphOptions& options,
                                   const std::vector<double>& kept_before = {});

}  // namespace sslcd
