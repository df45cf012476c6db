// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/export.h"
#include "sslcd/core/pose.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/core/timing.h"
#include "sslcd/perception/colour.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace SSLCD_EXPORT sslcd {

/// Hands out the frames of a sequence in order; none: that was the last one. May throw, and is not
/// asked again then.
using FrameSource = std::function<std::optional<Frame>()>;

/// Functions of the host for an offline run. All are optional and run on the calling thread.
struct RunHooks {
  std::function<void(int done, int total)> progress;  ///< after each frame
  /// gets the attempts to close a loop that are new or have changed (MapChanges::loops, with the
  /// early loops, which RunResult::loops has not), after a frame and after the refinement at the
  /// end
  std::function<void(const std::vector<LoopClosure>& changed)> loops;
  /// returns true to stop after this frame and keep the results
  std::function<bool()> stop;
  /// Loads an image for the colour cue and passes it to the callback; returns false on failure.
  /// Empty: no colour cue.
  std::function<bool(const std::string& path, const std::function<void(const ImageView&)>&)>
      with_image;
};

/// The result of an offline run.
struct RunResult {
  std::vector<int> frames;          ///< frame number of each pose of the trajectories
  Trajectory trajectory, odometry;  ///< T_world_cam and T_odom_cam of every processed frame
  std::vector<MapObject> objects;   ///< all landmarks by id; the confirmed ones are the map
  /// frames, metric odometry between them, accepted loops and ties of views
  PoseGraph graph;
  std::vector<LoopClosure> loops;  ///< all attempts in order, including refused ones
  LoopSearchSummary loop_search;   ///< why there are no more loops
  /// number of camera pairs aligned by their images (ViewAligner)
  int views_tied = 0;
  double scale = 1;                    ///< metres per odometry metre
  NoiseScale noise_scale;              ///< learnt factors on the detector's noise
  FilterReport filter;                 ///< sums over all frames
  BaSummary refinement;                ///< full-map optimisation at the end
  ImprovementProbability improvement;  ///< of the trajectory, by that optimisation
  TimingTable timing;
  int images_failed = 0;  ///< images that `with_image` could not load
  bool stopped = false;   ///< the stop hook ended the run early
};

/// Runs a whole sequence through a Mapper and refines the map at the end (also after a stop).
/// Deterministic. Throws what Mapper::AddFrame throws.
RunResult RunSequence(const std::vector<Frame>& frames, const MapperContext& context,
                      const Options& options, const RunHooks& hooks = {});

/// The same for a source of frames, e.g. ImageFrontend. Only the progress uses `total`.
RunResult RunSequence(const FrameSource& next, int total, const MapperContext& context,
                      const Options& options, const RunHooks& hooks = {});

}  // namespace sslcd
