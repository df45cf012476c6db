// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/surface.h"
#include "render/town.h"
#include "sim/halv.h"

namespace sslcd::render {

/// A grid of square cells over a rectangle. Each cell has the list of objects in or near it.
class GridIndex {
 public:
  GridIndex() = default;
  GridIndex(const Vec2f& low, const Vec2f& high, float cell);
  /// adds a number to all cells that the rectangle touches
  void Add(const Vec2f& low, const Vec2f& high, int number);
  const std::vector<int>& At(const Vec2f& place) const;

 private:
  Vec2f low_ = Vec2f::Zero();
  float cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> lists_;
};

/// Asphalt with stall lines, cracks, repairs and oil in the used area, grass elsewhere.
class Ground {
 public:
  Ground(const sim::HalvWorld& scene, const UsedArea& used, std::uint32_t seed);
  Surface At(const SurfacePoint& point) const;

 private:
  struct Line {
    Vec2f from, to;
  };
  float PavedShare(const Vec2f& place) const;  ///< 1: asphalt, 0: grass
  float PaintedShare(const Vec2f& place, float footprint) const;
  Vec3f Asphalt(const Vec2f& place, float footprint) const;

  std::uint32_t seed_;
  std::vector<Line> lines_;
  std::vector<Vec2f> oil_, used_;
  GridIndex near_lines_, near_oil_, near_used_;
};

}  // namespace sslcd::render
