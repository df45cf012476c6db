// SPDX-License-Identifier: BSD-3-Clause
#include "render/options.h"

namespace sslcd::render {

void DescribeFields(FieldVisitor& visitor, RenderOptions& options) {
  visitor.Real(
      "sun_azimuth_deg", options.out.sun_azimuth_deg, -360, 360,
      "where the sun is on the way out: 0 straight ahead of the first image, 90 to its right");
  visitor.Real("sun_elevation_deg", options.out.sun_elevation_deg, 1, 90,
               "height of the sun on the way out");
  visitor.Real("exposure", options.out.exposure, 0.01, 100,
               "brightness of the images on the way out");
  visitor.Real("warmth", options.out.warmth, -1, 1,
               "colour of the light on the way out: -1 bluish, 1 as in the evening");
  visitor.Real("back_sun_azimuth_deg", options.back.sun_azimuth_deg, -360, 360,
               "... where the sun is on the way back");
  visitor.Real("back_sun_elevation_deg", options.back.sun_elevation_deg, 1, 90, "... its height");
  visitor.Real("back_exposure", options.back.exposure, 0.01, 100, "... brightness");
  visitor.Real("back_warmth", options.back.warmth, -1, 1, "... colour of the light");
  visitor.Real("image_noise", options.noise, 0, 100, "noise of the images in grey levels");
  visitor.Real("vignetting", options.vignetting, 0, 0.9,
               "share of light lost in the images' corners");
  visitor.Flag("smooth_edges", options.smooth_edges,
               "four rays a pixel instead of one along edges");
}

}  // namespace sslcd::render
