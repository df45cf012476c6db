// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_graph.h"

#include <cmath>
#include <set>

#include "odometry/odometry_edge.h"
#include "refine/trajectory_correction.h"

namespace sslcd {

PoseGraph WithRefinedSteps(const FrameStore& frames, const LoopGraph& graph) {
  PoseGraph result = graph.graph;
  for (std::size_t k = 0; k < graph.first_loop; ++k) {
    PoseGraph::Edge& step = result.edges[k];
    if (FailuresBetween(frames, step.from, step.to).lost > 0) continue;
    const std::optional<Pose>&from = frames[step.from].T_refined_cam,
          &to = frames[step.to].T_refined_cam;
    if (from && to) step.T_from_to = from->inverse() * *to;
  }
  return result;
}

LoopGraph BuildLoopGraph(const FrameStore& frames, const std::vector<LoopEdge>& loops, double scale,
                         const Vec3& up, const LoopOptions& options,
                         const OdometryFactors& factors) {
  LoopGraph result;
  std::set<int> chosen;
  for (const int keyframe : SelectKeyframes(frames, options.keyframe_m, kGraphKeyframeRad))
    chosen.insert(keyframe);
  for (const LoopEdge& loop : loops) chosen.insert({loop.match, loop.query});
  result.keyframes.assign(chosen.begin(), chosen.end());
  PoseGraph& graph = result.graph;
  for (std::size_t k = 0; k < result.keyframes.size(); ++k) {
    graph.vertices.push_back(
        {result.keyframes[k], frames[result.keyframes[k]].T_world_cam, k == 0});
    if (k == 0) continue;
    PoseGraph::Edge& edge = graph.edges.emplace_back();
    edge.from = result.keyframes[k - 1];
    edge.to = result.keyframes[k];
    const OdometryEdge step =
        OdometryBetween(frames, edge.from, edge.to, {options.odometry, factors}, up, scale);
    edge.T_from_to = step.T_from_to;
    edge.information = step.information;
  }
  result.first_loop = graph.edges.size();
  result.kept_before.assign(graph.edges.size(), 1.);
  for (const LoopEdge& loop : loops) {
    const Eigen::Matrix<double, 6, 6> covariance = loop.closure->covariance;
    graph.edges.push_back(
        {loop.match, loop.query, loop.closure->T_match_query, covariance.inverse(), true});
    result.kept_before.push_back(loop.closure->decision == LoopDecision::kAccepted ? 1. : 0.);
  }
  return result;
}

}  // namespace sslcd
