// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/pose.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/core/timing.h"
#include "sslcd/perception/colour.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {

/// Hands out the frames of a sequence in order; none: that was the last one. May throw, and is not
/// asked again then.
using FrameSource = std::function<std::optional<Frame>()>;

/// What a host may hang into an offline run. All optional, all called from the calling thread.
struct RunHooks {
  std::function<void(int done, int total)> progress;  ///< after each frame
  /// true: finish this frame, keep what there is
  std::function<bool()> stop;
  /// Loads an image for the colour cue and hands it to the callback; false where that fails. None:
  /// no colour.
  std::function<bool(const std::string& path, const std::function<void(const ImageView&)>&)>
      with_image;
};

/// What came out of an offline run.
struct RunResult {
  std::vector<int> frames;          ///< frame numbers, in step with the trajectories
  Trajectory trajectory, odometry;  ///< T_world_cam, T_odom_cam of every frame that was processed
  std::vector<MapObject> objects;   ///< all landmarks, by id; the map is those that are confirmed
  /// frames, the metric odometry between them, accepted loops, ties of views
  PoseGraph graph;
  std::vector<LoopClosure> loops;  ///< every attempt to close one, in order
  /// pairs of cameras that were aligned by their images (ViewAligner)
  int views_tied = 0;
  double scale = 1;        ///< metres per odometry metre
  NoiseScale noise_scale;  ///< what was learnt of the detector
  FilterReport filter;
  BaSummary refinement;
  TimingTable timing;
  int images_failed = 0;
  bool stopped = false;  ///< the stop hook ended it early
};

/// Runs a whole sequence through a Mapper and refines the map at the end (also after a stop).
/// Deterministic. Throws what Mapper::AddFrame throws.
RunResult RunSequence(const std::vector<Frame>& frames, const MapperContext& context,
                      const Options& options, const RunHooks& hooks = {});

/// The same for frames that come one by one, e.g. made from images (frontend/image_frontend.h).
/// `total` is for the progress only.
RunResult RunSequence(const FrameSource& next, int total, const MapperContext& context,
                      const Options& options, const RunHooks& hooks = {});

}  // namespace sslcd
