// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/surface.h"
#include "sim/halv.h"

namespace sslcd::render {

/// Frame of the scene: x right, y where the first camera looks, z up from the ground.
Pose SceneFromWorld(const sim::World& world);

/// A house or a piece of wall: a box on the ground.
struct Building {
  Vec3f low, high;
  std::uint32_t seed = 0;
  bool wall = false;
};

/// What surrounds the objects: a wall around all that stands or drives within it, houses and trees
/// beyond.
struct Town {
  std::vector<Building> buildings;
  std::vector<Vec2f> trees;
};

/// Where something stands or drives at any time, which must stay free, and the rectangle about what
/// stands and about the camera's path.
struct UsedPlaces {
  std::vector<Vec2f> places;
  Vec2f low, high;
};
UsedPlaces FindUsedPlaces(const sim::World& world);

/// Nothing is built within some metres of the used places.
Town MakeTown(const UsedPlaces& used, std::uint32_t seed);

/// One mesh of all buildings; a triangle's part is its building's number.
Mesh MakeTownMesh(const Town& town);
Surface TownSurface(const Town& town, const Spot& spot);

}  // namespace sslcd::render
