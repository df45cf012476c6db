// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_corrector.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "closing/split_fused.h"
#include "loop/decision.h"
#include "loop/layout_likelihood.h"
#include "pose_graph/chains.h"
#include "refine/optimise_map.h"
#include "refine/trajectory_correction.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd {
namespace {

// Solves the graph and applies its verdict to the rows of `loops`. False: not solvable.
bool SolveAndDecide(LoopGraph& graph, const std::vector<LoopAttempt*>& loops,
                    const LoopOptions& options) {
  if (!options.robust) return SolvePoseGraph(graph.graph, options.graph.graph).usable;
  const RobustPoseGraphSummary summary = SolveRobust(graph.graph, options.graph, graph.kept_before);
  if (!summary.graph.usable) return false;
  for (std::size_t i = 0; i < loops.size(); ++i)
    ApplyGraphVerdict(summary.edge_weight[graph.first_loop + i] > 0, loops[i]->row());
  return true;
}

// Solves a graph with the accepted ones of its loops. False: not solvable.
bool SolveKept(PoseGraph& graph, const std::vector<LoopAttempt*>& loops,
               const LoopOptions& options) {
  std::vector<double> weights;
  for (const LoopAttempt* loop : loops) weights.push_back(loop->accepted() ? 1. : 0.);
  return SolveCondensed(graph, options.graph.graph, weights).usable;
}

}  // namespace

bool AgreesWithNewLoops(const MapState& state, const LoopLedger& ledger) {
  constexpr double kProbability = 0.9;  // of the chi-square test, 6 DoF; set by hand
  const std::vector<LoopAttempt>& attempts = ledger.attempts();
  return std::all_of(attempts.begin(), attempts.end(), [&](const LoopAttempt& attempt) {
    if (!attempt.in_graph || attempt.solved) return true;
    const LoopMeasurement& loop = attempt.found.loop;
    const Pose T =
        state.frames[loop.match].T_world_cam.inverse() * state.frames[loop.query].T_world_cam;
    return Agrees({loop.row.T_match_query, loop.row.covariance}, T, kProbability);
  });
}

bool CorrectTrajectory(MapState& state, LoopLedger& ledger, double scale,
                       const LoopOptions& options, const DetectionNoise& noise,
                       const OdometryFactors& factors) {
  std::vector<LoopAttempt*> loops;
  std::vector<LoopEdge> edges;
  for (LoopAttempt& attempt : ledger.attempts()) {
    if (!attempt.in_graph) continue;
    attempt.solved = true;
    loops.push_back(&attempt);
    edges.push_back({attempt.found.loop.match, attempt.found.loop.query, &attempt.row()});
  }
  LoopGraph graph =
      BuildLoopGraph(state.frames, edges, scale, state.gravity().up, options, factors);
  // Odometry decides about the loops. The refined steps have them in, wrong ones, too, and would
  // confirm them.
  PoseGraph refined = WithRefinedSteps(state.frames, graph);
  if (!SolveAndDecide(graph, loops, options)) return false;
  refined.vertices = graph.graph.vertices;
  if (state.frames.front().T_refined_cam && !ledger.RefinedByRefused() &&
      SolveKept(refined, loops, options))
    graph.graph = std::move(refined);
  const std::vector<Pose> before = PosesOf(state.frames);
  MoveKeyframes(state.frames, graph.keyframes, PosesOf(graph.graph));
  MoveObjects(state, before, noise);
  return true;
}

void FuseMatchedObjects(MapState& state, PassMap& passes, LoopLedger& ledger, double fuse_m,
                        const WholeMapOptions& options) {
  if (ledger.FusedByRefused()) {
    SplitFused(state, passes, options);
    ledger.ForgetFusions();
  }
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;
  const auto& all = state.map.landmarks();
  const auto seen = [&](const std::pair<int, int>& sighting) {
    return state.frames[sighting.first].matched[sighting.second];
  };
  for (LoopAttempt& attempt : ledger.attempts()) {
    if (!attempt.accepted()) continue;
    attempt.fused = true;
    for (const MatchedSightings& pair : attempt.pairs) {
      const LandmarkId local = seen(pair.local), global = seen(pair.global);
      const auto a = all.find(local.value), b = all.find(global.value);
      if (local == global || a == all.end() || b == all.end()) continue;
      if ((a->second.pose.position - b->second.pose.position).norm() <= fuse_m)
        pairs.push_back({global, local});
    }
  }
  if (!pairs.empty()) passes.Rename(FuseMatched(state, pairs, options));
}

BaSummary AdjustAfterLoop(MapState& state, double scale, const LoopOptions& options,
                          const WholeMapOptions& whole_map, const OdometryFactors& factors) {
  // Starts at the solution of the pose graph, where more iterations hardly change the result.
  constexpr int kMaxSteps = 4;
  const std::vector<int> keyframes =
      SelectKeyframes(state.frames, options.keyframe_m, kGraphKeyframeRad);
  if (static_cast<int>(keyframes.size()) > options.adjust_keyframes) return {};
  WholeMapOptions adjust = whole_map;
  adjust.map.learn_noise = false;
  adjust.ba.max_iterations = std::min(adjust.ba.max_iterations, kMaxSteps);
  adjust.ba.odometry = options.odometry;
  adjust.ba.odometry.scale_prior = 0;  // fixes the scale
  double log_scale = std::log(scale);
  return OptimiseMap(state, keyframes, log_scale, {factors, {}}, adjust);
}

YawShift LayoutChange(const Pose& T_before, const Pose& T_now, const GravityFrame& gravity) {
  YawShift change;
  change.yaw = gravity.YawOf(T_now.so3() * T_before.so3().inverse() * gravity.Upright(0));
  const Eigen::Matrix3d to_layout = gravity.Basis().transpose();
  change.t = to_layout * T_now.translation() - Apply(change, to_layout * T_before.translation());
  change.t.z() = 0;
  return change;
}

}  // namespace sslcd
