// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/surface.h"
#include "sim/halv.h"

namespace sslcd::render {

/// Frame of the scene: x right, y along the viewing direction of the first camera, z up from the
/// ground.
Pose SceneFromWorld(const sim::World& world);

/// A house or a piece of wall: a box on the ground.
struct Building {
  Vec3f low, high;
  std::uint32_t seed = 0;
  bool wall = false;
};

/// The surroundings of the objects: a wall around the used area, houses and trees beyond.
struct Town {
  std::vector<Building> buildings;
  std::vector<Vec2f> trees;
};

/// The places of all objects at any time, which must stay free, and the rectangle around the parked
/// objects and the camera's path.
struct UsedArea {
  std::vector<Vec2f> places;
  Vec2f low, high;
};
UsedArea FindUsedArea(const sim::World& world);

/// Keeps buildings some metres away from the used places.
Town MakeTown(const UsedArea& used, std::uint32_t seed);

/// One mesh of all buildings. The part of a triangle is the number of its building.
Mesh MakeTownMesh(const Town& town);
Surface TownSurface(const Town& town, const SurfacePoint& point);

}  // namespace sslcd::render
