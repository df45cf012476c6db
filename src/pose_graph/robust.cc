// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pose_graph/pose_graph.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

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
// Of chi2, as PoseGraphOptions::tolerance. The next solve goes on from there.
constexpr double kWarmTolerance = 1e-3;
// Largest share of the loops (at least one loop) that a warm start may refuse; with more,
// everything is solved again. Set by hand.
constexpr double kShareRefused = 0.02;

// Optimises a graph that starts at the geometry of its trusted edges. GNC may end in a local
// minimum, so it runs with all loops, with none, and with those that were kept before if some were
// not, and the lowest cost wins. If all loops agree, there is nothing else to decide.
// `kept_before`: weight per loop, or empty.
int SolveTruncated(PoseGraph& graph, const RobustPoseGraphOptions& options, double limit,
                   const std::vector<double>& kept_before) {
  CondensedGraph condensed(graph, IndexPoseGraph(graph).ends);  // loops come first, in order
  Gnc from_all(condensed.graph(), options, limit), from_none = from_all, from_kept = from_all;
  const Gnc* best = &from_all;
  const auto compare = [&best](const Gnc& other) {
    if (other.Cost() <= best->Cost()) best = &other;
  };
  from_all.Start(1);
  if (!from_all.AllAgree()) {
    from_all.Graduate();
    from_none.Start(0);
    from_none.Graduate();
    compare(from_none);
  }
  if (std::count(kept_before.begin(), kept_before.end(), 0.) > 0) {
    from_kept.Start(kept_before);
    from_kept.Graduate();
    compare(from_kept);
  }
  condensed.graph() = best->graph();
  condensed.Expand(graph);
  return from_all.rounds() + from_none.rounds() + from_kept.rounds();
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

// Selects among all loops, including ruled-out ones, by the poses of `work` and solves with the
// kept ones, repeatedly until nothing changes.
void Decide(PoseGraph& work, const RobustPoseGraphOptions& options,
            const std::vector<std::pair<int, int>>& ends, RobustPoseGraphSummary& summary) {
  for (int i = 0; i < kMaxDecisions; ++i) {
    std::vector<double> kept = KeepConsistent(work, ends, summary.chi2_limit);
    if (i > 0 && kept == summary.edge_weight) break;
    summary.edge_weight = std::move(kept);
    summary.graph = SolvePoseGraph(work, options.graph, summary.edge_weight);
    if (!summary.graph.usable) break;
  }
}

// Counts the loops and gives `graph` the poses of `work`, if it is solved.
void Report(const PoseGraph& work, PoseGraph& graph, RobustPoseGraphSummary& summary) {
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (graph.edges[e].loop)
      ++(summary.edge_weight[e] > 0 ? summary.loops_kept : summary.loops_refused);
  summary.graph.initial_chi2 = Chi2(graph, summary.edge_weight);
  if (!summary.graph.usable) return;
  graph.vertices = work.vertices;
  summary.graph.final_chi2 = Chi2(graph, summary.edge_weight);
}

struct WarmVerdict {
  std::vector<double> weights;  // per edge
  bool settled = false;         // the solution agrees with the loops it was solved with
};

// Starts at the poses and the kept loops of the previous solve, and solves the condensed graph
// alone, which has the same minimum to first order. None if it refuses more than few loops, or if
// the new ones distort the trusted edges more than one true loop does: then all loops must be
// decided again.
std::optional<WarmVerdict> SolveWarm(PoseGraph& graph, const RobustPoseGraphOptions& options,
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
  const double misfit_before = misfit_of_trusted();
  PoseGraphOptions inner = options.graph;
  inner.start = PoseGraphStart::kGiven;
  inner.tolerance = kWarmTolerance;
  WarmVerdict verdict;
  for (int i = 0; i < kMaxWarmDecisions && !verdict.settled; ++i) {
    if (!SolvePoseGraph(condensed.graph(), inner, weights).usable) return std::nullopt;
    std::vector<double> kept = KeepConsistent(condensed.graph(), ends, limit);
    verdict.settled = kept == weights;
    weights = std::move(kept);
  }
  if (static_cast<double>(refused()) > std::max(1., kShareRefused * static_cast<double>(loops)))
    return std::nullopt;
  if (misfit_of_trusted() - misfit_before > limit) return std::nullopt;
  condensed.Expand(graph);
  verdict.weights.assign(graph.edges.size(), 1.);
  loops = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (graph.edges[e].loop) verdict.weights[e] = weights[loops++];
  return verdict;
}

// Starts at the trusted edges, with the loops that these do not rule out. Returns the weight
// updates.
int SolveCold(PoseGraph& graph, const RobustPoseGraphOptions& options,
              const std::vector<std::pair<int, int>>& ends, double limit,
              const std::vector<double>& kept_before) {
  const TrustedTree tree(graph, ends);
  PoseGraph candidates;
  candidates.vertices = graph.vertices;
  for (std::size_t v = 0; v < graph.vertices.size(); ++v)
    if (!graph.vertices[v].fixed) candidates.vertices[v].T_world_vertex = tree.poses()[v];
  std::vector<double> candidates_before;
  const double ruled_out = limit * options.drift_factor * options.drift_factor;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const PoseGraph::Edge& edge = graph.edges[e];
    if (edge.loop && tree.Disagreement(edge, ends[e].first, ends[e].second) > ruled_out) continue;
    candidates.edges.push_back(edge);
    if (edge.loop && !kept_before.empty()) candidates_before.push_back(kept_before[e]);
  }
  const int rounds = SolveTruncated(candidates, options, limit, candidates_before);
  graph.vertices = candidates.vertices;
  return rounds;
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
  const bool decided_before = kept_before.size() == graph.edges.size();
  std::optional<WarmVerdict> warm;
  if (decided_before) warm = SolveWarm(work, options, kept_before, summary.chi2_limit);
  if (!warm)
    summary.rounds = SolveCold(work, options, index.ends, summary.chi2_limit,
                               decided_before ? kept_before : std::vector<double>());
  if (warm && warm->settled) {
    summary.edge_weight = std::move(warm->weights);
    summary.graph.usable = summary.graph.converged = true;
  } else {
    Decide(work, options, index.ends, summary);
  }
  Report(work, graph, summary);
  return summary;
}

}  // namespace sslcd
