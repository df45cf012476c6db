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
#include "sslcd/core/image.h"
#include "sslcd/frontend/options.h"
#include "sslcd/visual_odometry/odometry.h"

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

/// How a ground aligner works.
struct GroundAlignerOptions {
  /// find the disparity at infinity (CheckRig) when the first frames are to be aligned; needed
  /// where nobody has done so before
  bool check_rig = false;
  int threads = 1;  ///< the answers do not depend on it
  /// after each pair; one call at a time
  std::function<void(int done, int total)> progress;
};

/// Aligns frames by the ground in their stereo images (AlignGround), which are read again from
/// `files`; for MapperContext::view_aligner. One warning says what is wrong with images that cannot
/// be used; the aligner throws nothing. It answers nothing more when `files` are stopped.
ViewAligner MakeGroundAligner(StereoFiles files, const StereoCamera& camera,
                              const VisionOptions& vision, GroundAlignerOptions options = {});

}  // namespace sslcd
