// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "render/car_shape.h"
#include "render/vectors.h"

namespace sslcd::render {

/// Where a surface is looked at. Frame of the mesh; z counts from the ground.
struct Spot {
  Vec3f at, normal;
  int part = 0;
  float footprint = 0;  ///< width of a pixel there [m]
};

/// What light meets there.
struct Surface {
  Vec3f albedo = Vec3f::Constant(0.5f);
  float mirror = 0;   ///< share that is reflected head-on, as by a mirror; more at grazing angles
  float shine = 40;   ///< sharpness of the sun's reflection
  int kind = 0;       ///< distinguishes neighbours whose border should be smooth
  float light = 1;    ///< share of the sky that is not hidden by the object itself
  bool thin = false;  ///< light comes through from behind
};

Surface CarSurface(const CarShape& shape, const Vec3f& paint, const Spot& spot);
Surface PoleSurface(const Vec3f& paint, std::uint32_t seed, const Spot& spot);
Surface StopSurface(std::uint32_t seed, const Spot& spot);
Surface TreeSurface(const Vec3f& paint, std::uint32_t seed, const Spot& spot);

}  // namespace sslcd::render
