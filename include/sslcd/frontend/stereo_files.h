// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/closing/view_aligner.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/export.h"
#include "sslcd/core/image.h"
#include "sslcd/frontend/options.h"
#include "sslcd/visual_odometry/odometry.h"

namespace SSLCD_EXPORT sslcd {

/// The stereo images of a recorded sequence. The host decodes the files, not the library.
struct StereoFiles {
  /// left and right image file of each frame, by Frame::index; empty: there is none
  std::vector<std::pair<std::string, std::string>> paths;
  /// reads a file, in colour or grey as stored; returns an empty image on failure. Several threads
  /// may call it at the same time.
  std::function<Image(const std::string& path)> load;
  /// returns true to stop reading; empty: never stops
  std::function<bool()> stop;

  /// Whether the host asks to stop.
  bool stopped() const { return stop && stop(); }
  /// Whether any frame has both images.
  bool HasPairs() const;
};

/// Collects the image paths of frames whose index is their position.
StereoFiles StereoFilesOf(const std::vector<Frame>& frames,
                          std::function<Image(const std::string&)> load,
                          std::function<bool()> stop = {});

/// CheckRig on images from files. Logs the result. Ignores images that cannot be read or differ in
/// size from the first pair. Ends early if `files` are stopped.
RigCheck CheckRig(const StereoFiles& files, const StereoCamera& camera,
                  const StereoOdometryOptions& options);

/// AlignmentRange of the left camera [m], with the number of rows of the first left image. None: no
/// image can be read, or the camera sees no near ground.
std::optional<double> AlignmentRange(const StereoFiles& files, const Camera& left, double height_m);

/// Options of a ground aligner.
struct GroundAlignerOptions {
  /// estimate the disparity at infinity (CheckRig) at the first call; needed if nobody has done so
  /// before
  bool check_rig = false;
  int threads = 1;  ///< does not change the results
  /// called after each pair, never twice at the same time
  std::function<void(int done, int total)> progress;
};

/// Makes a MapperContext::view_aligner that aligns frames by the ground in their stereo images
/// (AlignGround), which it reads from `files`. It never throws; it warns once about unusable
/// images. It returns no further results when `files` are stopped.
ViewAligner MakeGroundAligner(StereoFiles files, const StereoCamera& camera,
                              const VisionOptions& vision, GroundAlignerOptions options = {});

}  // namespace sslcd
