// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/run.h"

#include "pipeline/frame_colours.h"

namespace sslcd {

RunResult RunSequence(const std::vector<Frame>& frames, const MapperContext& context,
                      const Options& options, const RunHooks& hooks) {
  std::size_t next = 0;
  const auto source = [&]() -> std::optional<Frame> {
    return next < frames.size() ? std::optional<Frame>(frames[next++]) : std::nullopt;
  };
  return RunSequence(source, static_cast<int>(frames.size()), context, options, hooks);
}

RunResult RunSequence(const FrameSource& next, int total, const MapperContext& context,
                      const Options& options, const RunHooks& hooks) {
  RunResult result;
  Mapper mapper(options, context);
  while (true) {
    if (hooks.stop && hooks.stop()) {
      result.stopped = true;
      break;
    }
    std::optional<Frame> frame = next();
    if (!frame) break;
    if (hooks.with_image && LacksColour(*frame)) {
      const ScopedTimer timer(mapper.timing(), "colour");
      result.images_failed += AddColours(*frame, options.colour, hooks) ? 0 : 1;
    }
    const FrameReport report = mapper.AddFrame(*frame);
    result.filter += report.filter;
    if (hooks.loops && !report.changes.loops.empty()) hooks.loops(report.changes.loops);
    result.frames.push_back(frame->index);
    result.odometry.stamps.push_back(frame->stamp);
    result.odometry.poses.push_back(frame->T_odom_cam);
    if (hooks.progress) hooks.progress(static_cast<int>(result.frames.size()), total);
  }
  if (options.refine.enabled) result.refinement = mapper.Refine();
  if (const MapChanges changes = mapper.TakeChanges(); hooks.loops && !changes.loops.empty())
    hooks.loops(changes.loops);
  result.trajectory = mapper.CameraTrajectory();
  result.graph = mapper.Graph();
  result.loops = WithoutEarly(mapper.LoopClosures());
  result.loop_search = mapper.SummariseLoopSearch();
  result.objects = mapper.Objects();
  result.views_tied = static_cast<int>(mapper.view_ties().size());
  result.improvement = mapper.improvement();
  result.scale = mapper.scale();
  result.noise_scale = mapper.noise_scale();
  result.timing = mapper.timing();
  return result;
}

}  // namespace sslcd
