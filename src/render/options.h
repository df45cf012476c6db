// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/fields.h"

namespace sslcd::render {

/// Sun and camera of one pass. Azimuth 0 is the viewing direction of the first camera, 90 is to its
/// right.
struct Light {
  double sun_azimuth_deg = 0;
  double sun_elevation_deg = 0;
  double exposure = 1;  ///< exposure of the camera
  double warmth = 0;    ///< colour of the light: -1 bluish like under clouds, 1 like in the evening
};

/// Options of rendering HALV-sim.
struct RenderOptions {
  Light out{130, 48, 1, 0};         ///< on the outward pass
  Light back{-115, 24, 1.15, 0.6};  ///< on the second pass
  /// standard deviation of the sensor's noise, in grey levels of 255
  double noise = 1.5;
  double vignetting = 0.25;  ///< share of light lost in the corners
  bool smooth_edges = true;  ///< four rays instead of one in pixels where two surfaces meet
};
void DescribeFields(FieldVisitor& visitor, RenderOptions& options);

}  // namespace sslcd::render
