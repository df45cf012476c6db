// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/run.h"

namespace sslcd {
namespace {

// Colour vectors for the detections that have a box and no colour yet; false when the image could not be read.
bool AddColours(Frame& frame, const ColourOptions& options, const RunHooks& hooks) {
  return hooks.with_image(frame.image_left, [&](const ImageView& image) {
    for (Detection& detection : frame.detections)
      if (detection.box && detection.colour.empty()) detection.colour = ColourVector(image, *detection.box, options);
  });
}

PoseGraph GraphOf(const Mapper& mapper, const OdometryNoise& noise) {
  PoseGraph graph;
  const std::vector<FrameRecord>& frames = mapper.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    graph.vertices.push_back({frames[i].frame, frames[i].T_world_cam, i == 0});
    if (i == 0) continue;
    PoseGraph::Edge& edge = graph.edges.emplace_back();
    edge.from = frames[i - 1].frame;
    edge.to = frames[i].frame;
    edge.T_from_to = frames[i - 1].T_odom_cam.inverse() * frames[i].T_odom_cam;
    const OdometrySigmas sigmas = SigmasOf(edge.T_from_to, noise);
    edge.T_from_to.translation() *= mapper.scale();
    edge.information.setZero();
    edge.information.diagonal().head<3>().setConstant(1 / (sigmas.translation * sigmas.translation));
    edge.information.diagonal().tail<3>().setConstant(1 / (sigmas.rotation * sigmas.rotation));
  }
  for (const LoopClosure& loop : mapper.LoopClosures()) {
    if (loop.decision != LoopDecision::kAccepted) continue;
    graph.edges.push_back({loop.match_frame, loop.query_frame, loop.T_match_query,
                           Eigen::Matrix<double, 6, 6>(loop.covariance).inverse(), true});
  }
  return graph;
}

}  // namespace

RunResult RunSequence(const std::vector<Frame>& frames, const MapperContext& context, const Options& options,
                      const RunHooks& hooks) {
  RunResult result;
  Mapper mapper(options, context);
  const int total = static_cast<int>(frames.size());
  for (int i = 0; i < total; ++i) {
    if (hooks.stop && hooks.stop()) {
      result.stopped = true;
      break;
    }
    Frame frame = frames[i];
    if (hooks.with_image && !frame.image_left.empty() && !frame.detections.empty()) {
      const ScopedTimer timer(mapper.timing(), "colour");
      result.images_failed += AddColours(frame, options.colour, hooks) ? 0 : 1;
    }
    result.filter += mapper.AddFrame(frame).filter;
    if (hooks.progress) hooks.progress(i + 1, total);
  }
  if (options.refine.enabled) result.refinement = mapper.Refine();

  for (std::size_t i = 0; i < mapper.frames().size(); ++i) {
    result.frames.push_back(frames[i].index);
    result.odometry.stamps.push_back(frames[i].stamp);
    result.odometry.poses.push_back(frames[i].T_odom_cam);
  }
  result.trajectory = mapper.CameraTrajectory();
  result.graph = GraphOf(mapper, options.ba.odometry);
  result.loops = mapper.LoopClosures();
  result.objects = mapper.Objects();
  result.scale = mapper.scale();
  result.noise_scale = mapper.map().noise_scale();
  result.timing = mapper.timing();
  return result;
}

}  // namespace sslcd
