// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/image.h"
#include "sslcd/visual_odometry/rig_check.h"

namespace sslcd {

/// The stereo images of a recorded sequence. The library decodes no files: the host does.
struct StereoFiles {
  /// left and right image file of each frame, by Frame::index; empty: it has none
  std::vector<std::pair<std::string, std::string>> paths;
  /// reads a file, in colour or grey as it is; an empty image where that fails. Called from several
  /// threads at once where there are several.
  std::function<Image(const std::string& path)> load;
  /// true: read nothing more; none: never
  std::function<bool()> stop;

  bool stopped() const { return stop && stop(); }
  /// Whether any frame has both images.
  bool HasPairs() const;
};

/// The image paths of frames whose indices are their positions.
StereoFiles StereoFilesOf(const std::vector<Frame>& frames,
                          std::function<Image(const std::string&)> load,
                          std::function<bool()> stop = {});

/// CheckRig on images from files; logs what it has found. Images that cannot be read, or have
/// another size than the first pair, are left out. Ends early when `files` are stopped.
RigCheck CheckRig(const StereoFiles& files, const StereoCamera& camera,
                  const StereoOdometryOptions& options);

/// AlignmentRange of the left camera, by the height of the first left image. None: no image can be
/// read, or the camera sees no near ground. [m]
std::optional<double> AlignmentRange(const StereoFiles& files, const Camera& left, double height_m);

}  // namespace sslcd
