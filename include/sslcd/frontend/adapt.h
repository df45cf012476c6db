// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/detection_noise.h"
#include "sslcd/core/export.h"
#include "sslcd/lifting/lift.h"
#include "sslcd/pipeline/options.h"

namespace SSLCD_EXPORT sslcd {

/// The parts of a mapper's input that come from images.
struct ImageSource {
  bool lifted_boxes = false;     ///< the detections are cuboids from LiftBoxes
  bool stereo_odometry = false;  ///< the poses are from StereoOdometry
  bool has_detections = true;    ///< false: only aligned images correct the odometry
  /// RigCheck::row_error divided by the focal length. None: unknown. [rad]
  std::optional<double> row_error_rad;
  /// AlignmentRange of the left camera. None: images are not aligned. [m]
  std::optional<double> alignment_range_m;
};

/// Options of a mapper for input from images that differ from the defaults. The numbers were
/// chosen on rendered HALV-sim, cases 1 to 4 with seeds 1 and 2, the scale prior also with seed 3
/// (docs/notes, "From images alone").
struct ImageModels {
  DetectionNoise lifted_noise = LiftNoise();  ///< Options::noise of lifted cuboids
  /// BaOptions::correlation of lifted cuboids (factor on standard deviations): their errors
  /// correlate over a whole pass, which shows one side of an object. 2 and 8 gave equal results.
  double lifted_correlation = 4;
  /// OdometryNoise::scale_prior if odometry and detections use the same baseline: an error of the
  /// baseline scales both equally, so there is no scale to estimate.
  double shared_scale_prior = 0;
};

/// Sets the options that `source` requires and keeps the others. It overwrites, so call it before
/// setting your own options. The odometry noise comes from StereoOdometryNoise. Returns the keys
/// that it has set, e.g. {"noise", "ba.correlation"}, so that a host can show them.
std::vector<std::string> AdaptTo(const ImageSource& source, Options& options,
                                 const ImageModels& models = {});

}  // namespace sslcd
