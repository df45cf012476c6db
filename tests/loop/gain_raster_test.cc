// SPDX-License-Identifier: BSD-3-Clause
#include "loop/gain_raster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "row_cases.h"

namespace sslcd {
namespace {

constexpr float kUnit = 0.05f;
const std::vector<LabelGain> kGains = {{0, 2.5f}, {1, 5.f}};

// The value of cell (x, y) of a tile's square.
int CellOf(const GainRaster& raster, const RasterShifts& shifts, int x, int y) {
  const Rasters from = raster.FromTile();
  return from.cells[shifts.cells[0] + y * from.stride + x];
}

// The bound of a block of such cells.
int BoundOf(const GainRaster& raster, const RasterShifts& shifts, int column, int row) {
  const Rasters from = raster.FromTile();
  return from.bounds[shifts.bounds[0] + row * from.bound_stride + column];
}

MapTiles MapOf(const std::vector<LayoutObject>& objects) {
  MapTiles map;
  for (const LayoutPoint& point : PointsOf(objects)) map.Add(point);
  return map;
}

TEST(GainRaster, IsTheGainOfTheNearestObject) {
  const std::vector<LayoutObject> park = CarPark({40, 40}, 0.5, 1);
  const MapTiles map = MapOf(park);
  GainRaster raster(kGains, kUnit, 20);
  int painted = 0;
  map.VisitAll([&](const MapTiles::Tile& tile) {
    raster.Enter(map, tile);
    for (std::size_t label = 0; label < kGains.size(); ++label)
      for (const Vec2& shift : {Vec2(0, 0), Vec2(7.5, -12.5)}) {
        RasterShifts shifts;
        raster.Append(label, static_cast<float>(shift.x()), static_cast<float>(shift.y()), shifts);
        for (int y = 0; y < Correlation::kSide; y += 3)
          for (int x = 0; x < Correlation::kSide; x += 3) {
            const Vec2 place =
                Vec2(tile.left, tile.bottom) + shift + GainRaster::kCell * Vec2(x + 0.5, y + 0.5);
            double nearest = 1e9;
            for (const LayoutObject& object : park)
              if (object.label == kGains[label].label)
                nearest = std::min(nearest, (object.position.head<2>() - place).norm());
            // an object paints as if it were up to an eighth of a cell aside, per axis
            const auto gain = [&](double d) {
              return std::max(
                  0., kGains[label].nats - d * d / (2. * GainRaster::kSigma * GainRaster::kSigma));
            };
            const double aside = std::sqrt(2.) * GainRaster::kCell / 8;
            const double value = kUnit * CellOf(raster, shifts, x, y);
            EXPECT_LE(value, gain(std::max(0., nearest - aside)) + kUnit / 2 + 1e-4);
            EXPECT_GE(value, gain(nearest + aside) - kUnit / 2 - 1e-4);
            painted += value > 0;
          }
      }
  });
  EXPECT_GT(painted, 100);
}

TEST(GainRaster, BoundsAreUpperBounds) {
  const MapTiles map = MapOf(CarParks(4, 3));
  GainRaster raster(kGains, kUnit, 30);
  int low = 0;
  map.VisitAll([&](const MapTiles::Tile& tile) {
    raster.Enter(map, tile);
    for (float shift = -30; shift <= 30; shift += 1.1f) {
      RasterShifts shifts;
      raster.Append(0, shift, 0.7f * shift, shifts);
      for (int y = 0; y < Correlation::kSide; ++y)
        for (int x = 0; x < Correlation::kSide; ++x) {
          const int bound =
              BoundOf(raster, shifts, x / Correlation::kBlock, y / Correlation::kBlock);
          ASSERT_LE(CellOf(raster, shifts, x, y), bound) << x << " " << y << " " << shift;
          low += bound == 0;
        }
    }
  });
  EXPECT_GT(low, 1000) << "and not everywhere the largest";
}

TEST(GainRaster, IgnoresOtherLabelsAndFarObjects) {
  MapTiles map;
  map.Add({40, 40, 0, 7});
  map.Add({400, 40, 0, 0});
  GainRaster raster(kGains, kUnit, 10);
  bool first = true;
  map.VisitAll([&](const MapTiles::Tile& tile) {
    if (!first) return;
    first = false;
    raster.Enter(map, tile);
    RasterShifts shifts;
    raster.Append(0, 0, 0, shifts);
    for (int y = 0; y < Correlation::kSide; ++y)
      for (int x = 0; x < Correlation::kSide; ++x) EXPECT_EQ(CellOf(raster, shifts, x, y), 0);
  });
}

}  // namespace
}  // namespace sslcd
