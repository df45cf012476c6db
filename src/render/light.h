// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "render/options.h"
#include "render/surface.h"

namespace sslcd::render {

/// Sun and sky of one pass. Frame of the scene: x right, y where the first camera looks, z up.
struct Daylight {
  Vec3f to_sun;
  Vec3f sun, zenith, horizon;  ///< linear red, green, blue
  float exposure = 1;
  std::uint32_t clouds = 0;  ///< seed
};
Daylight MakeDaylight(const Light& light, std::uint32_t seed);

/// The colour of the sky. `direction` is a unit vector.
Vec3f SkyColour(const Daylight& light, const Vec3f& direction);

/// Light from a surface towards the eye. `view` is the unit vector from the eye;
/// `sunlit` and `sky` are the visible shares of sun and sky.
Vec3f Shade(const Daylight& light, const Surface& surface, const Vec3f& normal, const Vec3f& view,
            float sunlit, float sky);

/// Haze: blends far objects with the colour of the horizon.
Vec3f ApplyHaze(const Daylight& light, const Vec3f& colour, float distance);

}  // namespace sslcd::render
