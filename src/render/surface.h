// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "render/car_shape.h"
#include "render/vectors.h"

namespace sslcd::render {

/// A point of a surface in the frame of the mesh; z counts from the ground.
struct Spot {
  Vec3f at, normal;
  int part = 0;
  float footprint = 0;  ///< width of a pixel there [m]
};

/// The material at a point.
struct Surface {
  Vec3f albedo = Vec3f::Constant(0.5f);
  float mirror = 0;   ///< mirrored share of light at normal incidence; more at grazing angles
  float shine = 40;   ///< sharpness of the sun's reflection
  int kind = 0;       ///< smooths the border between neighbours of different kinds
  float light = 1;    ///< share of the sky that the object does not hide
  bool thin = false;  ///< light passes from behind
};

Surface CarSurface(const CarShape& shape, const Vec3f& paint, const Spot& spot);
Surface PoleSurface(const Vec3f& paint, std::uint32_t seed, const Spot& spot);
Surface StopSurface(std::uint32_t seed, const Spot& spot);
Surface TreeSurface(const Vec3f& paint, std::uint32_t seed, const Spot& spot);

}  // namespace sslcd::render
