// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "render/car_shape.h"
#include "render/vectors.h"

namespace sslcd::render {

/// A point of a surface in the frame of the mesh; z counts from the ground.
struct SurfacePoint {
  Vec3f position, normal;
  int part = 0;
  float footprint = 0;  ///< width of a pixel at this point [m]
};

/// The material at a point.
struct Surface {
  Vec3f albedo = Vec3f::Constant(0.5f);
  float reflectivity = 0;  ///< mirrored share of light at normal incidence; more at grazing angles
  float shininess = 40;    ///< exponent of the sun's reflection (Phong)
  int kind = 0;            ///< smooths the border between neighbours of different kinds
  float sky_visibility = 1;  ///< share of the sky that the object does not hide
  bool translucent = false;  ///< light passes from behind
};

Surface CarSurface(const CarShape& shape, const Vec3f& paint, const SurfacePoint& point);
Surface PoleSurface(const Vec3f& paint, std::uint32_t seed, const SurfacePoint& point);
Surface WheelStopSurface(std::uint32_t seed, const SurfacePoint& point);
Surface TreeSurface(const Vec3f& paint, std::uint32_t seed, const SurfacePoint& point);

}  // namespace sslcd::render
