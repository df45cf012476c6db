// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "sslcd/closing/view_aligner.h"
#include "sslcd/frontend/options.h"
#include "sslcd/frontend/stereo_files.h"

namespace sslcd {

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
