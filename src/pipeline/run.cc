// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/run.h"

namespace sslcd {
namespace {

// Colour vectors for the detections that have a box and no colour yet; false when the image could not be read.
bool AddColours(Frame& frame, const ColourOptions& options, const RunHooks& hooks) {
  return hooks.with_image(frame.image_left, [&](const ImageView& image) {
    for (Detection& detection : frame.detections)
      if (detection.box && detection.colour.empty())
        detection.colour = ColourVector(image, *detection.box, options);
  });
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

  for (const FrameRecord& record : mapper.frames()) {
    result.frames.push_back(record.frame);
    result.odometry.stamps.push_back(record.stamp);
    result.odometry.poses.push_back(record.T_odom_cam);
  }
  result.trajectory = mapper.CameraTrajectory();
  result.objects = mapper.Objects();
  result.scale = mapper.scale();
  result.noise_scale = mapper.map().noise_scale();
  result.timing = mapper.timing();
  return result;
}

}  // namespace sslcd
