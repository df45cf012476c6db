// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/adapt.h"

#include "sslcd/visual_odometry/odometry.h"

namespace sslcd {

std::vector<std::string> AdaptTo(const ImageSource& source, Options& options,
                                 const ImageModels& models) {
  std::vector<std::string> keys;
  if (source.alignment_range_m) {
    options.loop.views.ahead_m = *source.alignment_range_m;
    keys.push_back("loop.views.ahead_m");
  }
  if (source.lifted_boxes) {
    options.noise = models.lifted_noise;
    options.ba.correlation = models.lifted_correlation;
    keys.insert(keys.end(), {"noise", "ba.correlation"});
  }
  if (source.stereo_odometry) {
    OdometryNoise noise = StereoOdometryNoise(source.row_error_rad);
    if (source.lifted_boxes || !source.has_detections)
      noise.scale_prior = models.shared_scale_prior;
    // Uses the errors that loops reveal over kilometres also for the window.
    options.ba.odometry = noise;
    options.loop.odometry = noise;
    keys.insert(keys.end(), {"ba.odometry", "loop.odometry"});
  }
  return keys;
}

}  // namespace sslcd
