// SPDX-License-Identifier: BSD-3-Clause
// Loops in a pose graph of your own: odometry edges with your covariance, loops with sslcd's. A
// loop may be measured again or withdrawn, so edges are kept by the loop's id.
//   02_own_pose_graph SEQUENCE    a folder as in docs/formats.md, e.g. tests/data/sim_rectangle
#include <sslcd/sslcd.h>

#include <cstdio>
#include <map>
#include <vector>

// snippet: loop_edge
// The edge of a loop. sslcd measures in metres, the odometry has a unit of its own.
sslcd::PoseGraph::Edge EdgeOf(const sslcd::LoopClosure& loop, double scale) {
  sslcd::PoseGraph::Edge edge;
  edge.from = loop.match_frame;
  edge.to = loop.query_frame;
  edge.T_from_to = loop.T_match_query;
  edge.T_from_to.translation() /= scale;
  edge.information = loop.covariance.inverse();  // [translation, rotation], right perturbation
  edge.loop = true;                              // may be refused
  return edge;
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sslcd::DatasetRequest request;
  request.path = argv[1];
  const sslcd::Dataset data = sslcd::LoadDataset(request);
  const auto gravity = sslcd::GravityFrame::FromUp(data.up_axis);
  sslcd::Mapper mapper(sslcd::Options(), {gravity, data.labels, data.camera});

  sslcd::PoseGraph graph;
  sslcd::PoseGraph::Edge step;
  step.information.diagonal() << 400, 400, 400, 4e4, 4e4, 4e4;  // 5 cm, 5 mrad
  sslcd::Pose T_odom_before;
  std::map<int, sslcd::LoopClosure> loops;  // the accepted ones, by id
  for (const sslcd::Frame& frame : data.frames) {
    graph.vertices.push_back({frame.index, frame.T_odom_cam, frame.index == 0});
    step.to = frame.index;
    step.T_from_to = T_odom_before.inverse() * frame.T_odom_cam;
    if (frame.index > 0) graph.edges.push_back(step);
    step.from = frame.index;
    T_odom_before = frame.T_odom_cam;

    for (const sslcd::LoopClosure& loop : mapper.AddFrame(frame).changes.loops) {
      if (loop.decision == sslcd::LoopDecision::kAccepted)
        loops[loop.id] = loop;
      else
        loops.erase(loop.id);
    }
  }
  for (const auto& [id, loop] : loops) graph.edges.push_back(EdgeOf(loop, mapper.scale()));
  const std::vector<sslcd::Pose> odometry = PosesOf(graph);
  const auto summary = sslcd::SolveRobust(graph, {});  // yours: GTSAM, g2o, ...
  const auto ate = [&](const std::vector<sslcd::Pose>& poses) {
    return sslcd::ComputeAte(poses, data.groundtruth->poses).error.rmse;
  };
  std::printf("%d loops kept, %d refused; ATE %.2f m, of the odometry %.2f m\n", summary.loops_kept,
              summary.loops_refused, ate(PosesOf(graph)), ate(odometry));
}
