// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/loop_graph.h"

#include <cmath>
#include <set>

#include "pipeline/move.h"
#include "sslcd/loop/layout_likelihood.h"

namespace sslcd {

LoopGraph BuildLoopGraph(const std::vector<FrameRecord>& frames, const std::vector<LoopEdge>& loops,
                         double scale, const Vec3& up, const LoopOptions& options) {
  constexpr double kTurn = 0.5;  // [rad] that makes a keyframe
  LoopGraph result;
  std::set<int> chosen;
  for (const int keyframe : SelectKeyframes(frames, options.keyframe_m, kTurn))
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
    edge.T_from_to = frames[edge.from].T_odom_cam.inverse() * frames[edge.to].T_odom_cam;
    const Vec3 up_here = frames[edge.to].T_world_cam.so3().inverse() * up;
    edge.information = InformationOf(SigmasOf(edge.T_from_to, options.odometry), up_here);
    edge.T_from_to.translation() *= scale;
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

YawShift LayoutChange(const Pose& T_before, const Pose& T_now, const GravityFrame& gravity) {
  const Vec3 forward = (T_now * T_before.inverse()).so3() * gravity.forward;
  YawShift change;
  change.yaw = std::atan2(forward.dot(gravity.left), forward.dot(gravity.forward));
  const Eigen::Matrix3d to_layout = gravity.Basis().transpose();
  change.t = to_layout * T_now.translation() - Apply(change, to_layout * T_before.translation());
  change.t.z() = 0;
  return change;
}

}  // namespace sslcd
