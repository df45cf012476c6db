// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/fields.h"

namespace sslcd::render {

/// Sun and camera of one pass. Directions are those of the world: azimuth 0 is where the first
/// camera looks, 90 to its right.
struct Light {
  double sun_azimuth_deg = 0;
  double sun_elevation_deg = 0;
  double exposure = 1;  ///< of the camera
  double warmth = 0;    ///< colour of the light: -1 bluish, as under clouds, 1 as in the evening
};

/// How HALV-sim is rendered.
struct RenderOptions {
  Light out{130, 48, 1, 0};         ///< on the way out
  Light back{-115, 24, 1.15, 0.6};  ///< on the way back
  /// standard deviation of the sensor's noise, in grey levels of 255
  double noise = 1.5;
  double vignetting = 0.25;  ///< share of light lost in the corners
  bool smooth_edges = true;  ///< four rays instead of one where two surfaces meet in a pixel
};
void DescribeFields(FieldVisitor& visitor, RenderOptions& options);

}  // namespace sslcd::render
