// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pose_graph/pose_graph.h"

#include <algorithm>
#include <utility>

#include "core/math.h"
#include "pose_graph/chains.h"
#include "pose_graph/cost.h"
#include "pose_graph/gnc.h"
#include "pose_graph/index.h"
#include "pose_graph/tree.h"

namespace sslcd {
namespace {

constexpr int kMaxDecisions = 5;      // rounds of decisions on all loops; usually two
constexpr int kMaxWarmDecisions = 3;  // the same with a previous solution
// Largest share of the loops (at least one loop) that a warm start may additionally refuse; with
// more, everything is solved again. Set by hand.
constexpr double kShareOfNew = 0.02;

// Optimises a graph that starts at the geometry of its trusted edges. GNC may end in a local
// minimum, so it runs with all loops and with none, and the lower cost wins. If all loops agree,
// there is nothing to decide.
int SolveTruncated(PoseGraph& graph, const RobustPoseGraphOptions& options, double limit) {
  CondensedGraph condensed(graph, IndexPoseGraph(graph).ends);
  Gnc from_all(condensed.graph(), options, limit), from_none = from_all;
  from_all.Start(1);
  const Gnc* best = &from_all;
  if (!from_all.AllAgree()) {
    from_all.Graduate();
    from_none.Start(0);
    from_none.Graduate();
    if (from_none.Cost() <= from_all.Cost()) best = &from_none;
  }
  condensed.graph() = best->graph();
  condensed.Expand(graph);
  return from_all.rounds() + from_none.rounds();
}

// Weight per edge: 0 for a loop beyond the limit, else 1.
std::vector<double> KeepConsistent(const PoseGraph& graph,
                                   const std::vector<std::pair<int, int>>& ends, double limit) {
  std::vector<double> weights;
  for (std::size_t e = 0; e < ends.size(); ++e)
    weights.push_back(!graph.edges[e].loop || EdgeChi2(graph, ends, e) <= limit ? 1 : 0);
  return weights;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, RobustPoseGraphOptions& options) {
  DescribeFields(visitor, options.graph);
  visitor.Real("inlier_probability", options.inlier_probability, 0.5, 1 - 1e-9,
               "probability with which a true loop is kept; sets the limit of its chi2");
  visitor.Real("drift_factor", options.drift_factor, 1, 1e6,
               "a loop that would need odometry errors this many times larger than expected is "
               "refused at first");
}

namespace {

// The chi2 against the trusted edges above which a loop is ruled out.
double RuledOut(double chi2_limit, const RobustPoseGraphOptions& options) {
  return chi2_limit * options.drift_factor * options.drift_factor;
}

// Selects among all loops, including ruled-out ones, by the poses of `work` and solves with the
// kept ones, repeatedly until nothing changes. `graph` gets the result of `work`.
void Decide(PoseGraph& work, const RobustPoseGraphOptions& options,
            const std::vector<std::pair<int, int>>& ends, PoseGraph& graph,
            RobustPoseGraphSummary& summary) {
  for (int i = 0; i < kMaxDecisions; ++i) {
    std::vector<double> kept = KeepConsistent(work, ends, summary.chi2_limit);
    if (i > 0 && kept == summary.edge_weight) break;
    summary.edge_weight = std::move(kept);
    summary.graph = SolvePoseGraph(work, options.graph, summary.edge_weight);
    if (!summary.graph.usable) break;
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (graph.edges[e].loop)
      ++(summary.edge_weight[e] > 0 ? summary.loops_kept : summary.loops_refused);
  summary.graph.initial_chi2 = Chi2(graph, summary.edge_weight);
  if (!summary.graph.usable) return;
  graph.vertices = work.vertices;
  summary.graph.final_chi2 = Chi2(graph, summary.edge_weight);
}

// Starts at the poses and the kept loops of the previous solve. False if it refuses more loops than
// the new ones explain, or if the new ones distort the trusted edges more than one true loop can:
// then all loops must be decided again.
bool SolveWarm(PoseGraph& graph, const RobustPoseGraphOptions& options,
               const std::vector<double>& kept_before, double limit) {
  CondensedGraph condensed(graph, IndexPoseGraph(graph).ends);  // loops come first, in order
  const auto ends = IndexPoseGraph(condensed.graph()).ends;
  std::vector<double> weights(ends.size(), 1.);
  std::size_t loops = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (graph.edges[e].loop) weights[loops++] = kept_before[e];
  const auto refused = [&] { return std::count(weights.begin(), weights.end(), 0.); };
  const auto misfit_of_trusted = [&] {
    double sum = 0;
    for (std::size_t e = 0; e < ends.size(); ++e)
      if (!condensed.graph().edges[e].loop) sum += EdgeChi2(condensed.graph(), ends, e);
    return sum;
  };
  const auto refused_before = refused();
  const double misfit_before = misfit_of_trusted();
  PoseGraphOptions inner = options.graph;
  inner.start = PoseGraphStart::kGiven;
  for (int i = 0; i < kMaxWarmDecisions; ++i) {
    if (!SolvePoseGraph(condensed.graph(), inner, weights).usable) return false;
    std::vector<double> kept = KeepConsistent(condensed.graph(), ends, limit);
    const bool settled = kept == weights;
    weights = std::move(kept);
    if (settled) break;
  }
  if (static_cast<double>(refused() - refused_before) >
      std::max(1., kShareOfNew * static_cast<double>(loops)))
    return false;
  if (misfit_of_trusted() - misfit_before > RuledOut(limit, options)) return false;
  condensed.Expand(graph);
  return true;
}

}  // namespace

RobustPoseGraphSummary SolveRobust(PoseGraph& graph, const RobustPoseGraphOptions& options,
                                   const std::vector<double>& kept_before) {
  RobustPoseGraphSummary summary;
  const PoseGraphIndex index = IndexPoseGraph(graph);
  summary.edge_weight.assign(graph.edges.size(), 1.);
  if (!index.trouble.empty()) {
    summary.graph.message = "not optimised: " + index.trouble;
    return summary;
  }
  summary.chi2_limit =
      Chi2Quantile(options.inlier_probability, DegreesOfFreedom(options.graph.freedom));
  // measurements restricted to the freedom of the vertices, since only these components decide
  // about a loop
  PoseGraph work = graph;
  for (std::size_t e = 0; e < work.edges.size(); ++e) {
    const auto [from, to] = index.ends[e];
    work.edges[e] =
        EdgeWithin(options.graph.freedom, options.graph.gravity.up, work.edges[e],
                   work.vertices[from].T_world_vertex, work.vertices[to].T_world_vertex);
  }
  if (kept_before.size() == graph.edges.size() &&
      SolveWarm(work, options, kept_before, summary.chi2_limit)) {
    Decide(work, options, index.ends, graph, summary);
    return summary;
  }
  const TrustedTree tree(work, index.ends);
  PoseGraph candidates;  // graph with the loops that odometry does not rule out
  candidates.vertices = work.vertices;
  for (std::size_t v = 0; v < work.vertices.size(); ++v)
    if (!work.vertices[v].fixed) candidates.vertices[v].T_world_vertex = tree.poses()[v];
  const double ruled_out = RuledOut(summary.chi2_limit, options);
  for (std::size_t e = 0; e < work.edges.size(); ++e) {
    const PoseGraph::Edge& edge = work.edges[e];
    if (!edge.loop ||
        tree.Disagreement(edge, index.ends[e].first, index.ends[e].second) <= ruled_out)
      candidates.edges.push_back(edge);
  }
  summary.rounds = SolveTruncated(candidates, options, summary.chi2_limit);
  work.vertices = candidates.vertices;

  Decide(work, options, index.ends, graph, summary);
  return summary;
}

}  // namespace sslcd
