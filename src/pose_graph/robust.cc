// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pose_graph/pose_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/math.h"
#include "pose_graph/chains.h"
#include "pose_graph/cost.h"
#include "pose_graph/index.h"
#include "pose_graph/tree.h"

namespace sslcd {
namespace {

// Iterations per weight update. The next update starts at this solution and needs one or two.
constexpr int kInnerIterations = 20;
// Weight updates from each of two starts. They multiply mu by 4e14 at a factor of 1.4.
constexpr int kMaxRounds = 100;
constexpr int kMaxDecisions = 5;      // rounds of decisions on all loops; usually two
constexpr int kMaxWarmDecisions = 3;  // the same with a previous solution
// Share of the chi-square limit; with a smaller chi-square all loops agree.
constexpr double kLeastMisfit = 1e-3;
// Largest share of the loops (at least one loop) that a warm start may additionally refuse; with
// more, everything is solved again. Set by hand.
constexpr double kShareOfNew = 0.02;

double EdgeChi2(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends,
                std::size_t e) {
  const PoseGraph::Edge& edge = graph.edges[e];
  const Vec6 error = EdgeError(edge, graph.vertices[ends[e].first].T_world_vertex,
                               graph.vertices[ends[e].second].T_world_vertex);
  return error.dot(edge.information * error);
}

// Yang et al. Eq. 14: the weight that minimises the TLS surrogate for one residual.
double Weight(double chi2, double mu, double limit) {
  if (chi2 >= (mu + 1) / mu * limit) return 0;
  if (chi2 <= mu / (mu + 1) * limit) return 1;
  return std::sqrt(limit / chi2 * mu * (mu + 1)) - mu;
}

// Truncated least squares over the loops of a graph with given initial values.
class Gnc {
 public:
  Gnc(const PoseGraph& graph, const RobustPoseGraphOptions& options, double limit)
      : graph_(graph),
        ends_(IndexPoseGraph(graph).ends),
        options_(options),
        limit_(limit),
        weights_(ends_.size(), 1.),
        chi2_(ends_.size()) {
    options_.graph.start = PoseGraphStart::kGiven;
    options_.graph.max_iterations = kInnerIterations;
  }

  /// Solves with all loops on (1) or off (0).
  void Start(double weight) {
    SetWeights([weight](double) { return weight; });
    Solve();
  }

  void Graduate() {
    double mu = limit_ / std::max(2 * Worst() - limit_, kLeastMisfit * limit_);
    for (bool undecided = true; undecided && rounds_ < kMaxRounds; mu *= options_.mu_factor) {
      SetWeights([&](double loop_chi2) { return Weight(loop_chi2, mu, limit_); });
      undecided =
          std::any_of(weights_.begin(), weights_.end(), [](double w) { return w > 0 && w < 1; });
      Solve();
      ++rounds_;
    }
  }

  /// Whether the total chi2 is plausible for true loops and no single loop is an outlier.
  bool AllAgree() const {
    const auto loops = std::count_if(graph_.edges.begin(), graph_.edges.end(),
                                     [](const auto& e) { return e.loop; });
    const double expected = static_cast<double>(loops) * DegreesOfFreedom(options_.graph.freedom);
    return Worst() <= limit_ && std::accumulate(chi2_.begin(), chi2_.end(), 0.) <= expected;
  }

  /// The cost: a loop beyond the limit costs the limit.
  double Cost() const {
    double cost = 0;
    for (std::size_t e = 0; e < chi2_.size(); ++e)
      cost += graph_.edges[e].loop ? std::min(chi2_[e], limit_) : chi2_[e];
    return cost;
  }

  const PoseGraph& graph() const { return graph_; }
  int rounds() const { return rounds_; }

 private:
  template <class WeightOfChi2>
  void SetWeights(const WeightOfChi2& weight) {
    for (std::size_t e = 0; e < ends_.size(); ++e)
      if (graph_.edges[e].loop) weights_[e] = weight(chi2_[e]);
  }
  void Solve() {
    SolvePoseGraph(graph_, options_.graph, weights_);
    for (std::size_t e = 0; e < ends_.size(); ++e) chi2_[e] = EdgeChi2(graph_, ends_, e);
  }
  double Worst() const {
    double worst = 0;
    for (std::size_t e = 0; e < ends_.size(); ++e)
      if (graph_.edges[e].loop) worst = std::max(worst, chi2_[e]);
    return worst;
  }

  PoseGraph graph_;
  std::vector<std::pair<int, int>> ends_;
  RobustPoseGraphOptions options_;
  double limit_;
  std::vector<double> weights_, chi2_;  // per edge
  int rounds_ = 0;
};

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

// Keeps the loops within the limit. False if these are the same as before.
bool KeepConsistent(const PoseGraph& graph, const std::vector<std::pair<int, int>>& ends,
                    RobustPoseGraphSummary& summary) {
  bool changed = !summary.graph.usable;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    if (!graph.edges[e].loop) continue;
    const double weight = EdgeChi2(graph, ends, e) <= summary.chi2_limit ? 1 : 0;
    changed |= weight != summary.edge_weight[e];
    summary.edge_weight[e] = weight;
  }
  return changed;
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
  for (int i = 0; i < kMaxDecisions && KeepConsistent(work, ends, summary); ++i) {
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
               const std::vector<double>& kept_before, RobustPoseGraphSummary& summary) {
  CondensedGraph condensed(graph, IndexPoseGraph(graph).ends);  // loops come first, in order
  std::vector<std::size_t> loops;
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (graph.edges[e].loop) loops.push_back(e);
  const auto refused = [&](const std::vector<double>& weights) {
    return std::count_if(loops.begin(), loops.end(),
                         [&](std::size_t e) { return weights[e] == 0; });
  };
  RobustPoseGraphSummary decided = summary;
  std::vector<double> weights(condensed.graph().edges.size(), 1.);
  for (std::size_t i = 0; i < loops.size(); ++i) weights[i] = kept_before[loops[i]];
  PoseGraphOptions inner = options.graph;
  inner.start = PoseGraphStart::kGiven;
  const auto ends = IndexPoseGraph(condensed.graph()).ends;
  const auto misfit_of_trusted = [&] {
    double sum = 0;
    for (std::size_t e = loops.size(); e < ends.size(); ++e)
      sum += EdgeChi2(condensed.graph(), ends, e);
    return sum;
  };
  const double misfit_before = misfit_of_trusted();
  for (int i = 0; i < kMaxWarmDecisions; ++i) {
    if (!SolvePoseGraph(condensed.graph(), inner, weights).usable) return false;
    bool changed = false;
    for (std::size_t e = 0; e < loops.size(); ++e) {
      const double weight = EdgeChi2(condensed.graph(), ends, e) <= summary.chi2_limit ? 1 : 0;
      changed |= weight != weights[e];
      decided.edge_weight[loops[e]] = weights[e] = weight;
    }
    if (!changed) break;
  }
  if (static_cast<double>(refused(decided.edge_weight) - refused(kept_before)) >
      std::max(1., kShareOfNew * static_cast<double>(loops.size())))
    return false;
  if (misfit_of_trusted() - misfit_before > RuledOut(summary.chi2_limit, options)) return false;
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
  if (kept_before.size() == graph.edges.size() && SolveWarm(work, options, kept_before, summary)) {
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
