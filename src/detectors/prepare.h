// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "detectors/model_description.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/image.h"

namespace sslcd {

/// The map from image to model input: x * scale_x + offset_x, y * scale_y + offset_y. [px]
struct InputMap {
  double scale_x = 1, scale_y = 1, offset_x = 0, offset_y = 0;

  Vec2 ToImage(double x, double y) const {
    return {(x - offset_x) / scale_x, (y - offset_y) / scale_y};
  }
  Vec2 ToInput(double x, double y) const {
    return {x * scale_x + offset_x, y * scale_y + offset_y};
  }
};

/// Writes one image as three planes of width x height, one per channel, to `planes`. Throws
/// Error(kBadInput) with the prefix `what` if the image is not B G R or has no rows left after
/// cropping.
InputMap Prepare(const ImageView& image, const ModelInput& input, int width, int height,
                 const char* what, float* planes);

}  // namespace sslcd
