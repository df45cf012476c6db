// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/detection_noise.h"
#include "sslcd/lifting/lift.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {

/// What of a mapper's input comes from images.
struct ImageSource {
  bool lifted_boxes = false;     ///< the detections are cuboids that LiftBoxes has made
  bool stereo_odometry = false;  ///< the poses are those of StereoOdometry
  bool has_detections = true;    ///< false: nothing but aligned images corrects the odometry
  /// RigCheck::row_error over the focal length. None: not known. [rad]
  std::optional<double> row_error_rad;
  /// AlignmentRange of the left camera. None: its images are not aligned. [m]
  std::optional<double> alignment_range_m;
};

/// What a mapper should expect of images, where that is not what it expects of detections and
/// odometry of unknown origin. The three numbers were chosen on HALV-sim, rendered, cases 1 to 4
/// with seeds 1 and 2, and the scale's also with seed 3 (docs/notes, "From images alone").
struct ImageModels {
  DetectionNoise lifted_noise = LiftNoise();  ///< Options::noise of lifted cuboids
  /// BaOptions::loss_scale of lifted cuboids: some headings are a quarter turn off, which a
  /// narrower loss makes less of [sigmas]
  double lifted_loss_scale = 1;
  /// BaOptions::correlation of lifted cuboids: their errors are alike on a whole pass, since it
  /// shows one side of an object. Factor on standard deviations; 2 and 8 were as good.
  double lifted_correlation = 4;
  /// OdometryNoise::scale_prior where odometry and what corrects it are measured by the same
  /// baseline: an error of the baseline stretches both alike, so there is no scale to estimate.
  double shared_scale_prior = 0;
};

/// Sets what `source` says in `options`; everything else stays. It overwrites: call it before
/// options of your own are set. Which odometry noise is expected is told by StereoOdometryNoise.
/// Returns the keys that it has set, e.g. {"noise", "ba.loss_scale"}, so that a host can show them.
std::vector<std::string> AdaptTo(const ImageSource& source, Options& options,
                                 const ImageModels& models = {});

}  // namespace sslcd
