// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "loop/correlate.h"
#include "loop/map_tiles.h"

namespace sslcd {

/// A label and what an object of it gains at most by a match. [nats]
struct LabelGain {
  int label = 0;
  float nats = 0;
};

/// Gains of a local object by the cell in which a pose puts it, for the surroundings of a tile of a
/// map:
///   raster(cell) = max over objects j of its label of  gain - |cell - j|^2 / (2 kSigma^2),
/// at least 0. In whole units of `unit` nats.
class GainRaster {
 public:
  static constexpr float kCell = MapTiles::kSide / Correlation::kSide;  // [m]
  /// Standard deviation of an object's place under a pose of the search: errors of the two maps, of
  /// the heading (kBinRad) and of the cell. Set by hand. [m]
  static constexpr float kSigma = 0.7f;

  /// `reach_m`: largest distance of a local object from the pose.
  GainRaster(const std::vector<LabelGain>& gains, float unit, float reach_m);

  /// Sets the tile of the poses. Paints its group of tiles, unless the last tile was of it.
  void Enter(const MapTiles& map, const MapTiles::Tile& tile);

  /// The rasters seen from the poses of the tile.
  Rasters FromTile() const;

  /// Adds the shift of the raster of the label with the index `label` in `gains`: the local object
  /// is at (x, y) from a pose. The same for all tiles. [m]
  void Append(std::size_t label, float x, float y, RasterShifts& shifts) const;

 private:
  static constexpr int kStamp = 8;   // side of the square that an object paints [cells]
  static constexpr int kPhases = 4;  // positions within a cell, per axis

  using StampRow = std::uint8_t __attribute__((vector_size(kStamp)));
  struct Stamp {
    std::array<StampRow, kStamp> rows{};
    int bottom = kStamp, top = 0, left = kStamp, right = 0;  // first and last cells above zero
  };
  struct Layer {
    int label = 0;
    std::array<Stamp, kPhases * kPhases> stamps{};  // by row and column of the phase
    std::array<StampRow, kStamp + 1> bound_rows{};  // the label's gain, by number of blocks
  };
  static void Raise(std::uint8_t* to, const StampRow& by);
  void Paint(const MapTiles& map, double left, double bottom);
  void PaintObject(float column, float row, std::size_t layer);

  int CellsOfLayer() const { return side_ * stride_; }
  int BoundsOfLayer() const { return bound_side_ * bound_stride_; }

  int margin_, side_, stride_, bound_side_, bound_stride_;  // [cells], [blocks]
  int group_column_ = -1, group_row_ = -1;                  // of the painted group
  int tile_column_ = 0, tile_row_ = 0;                      // of the tile in its group [tiles]
  std::vector<Layer> layers_;
  // One layer after the other. A bound of a block is that of the cells of this block and the next
  // ones, per axis: a shifted block meets them. The first row and column of bounds is that of the
  // block before the first.
  std::vector<std::uint8_t> cells_, bounds_;
  std::vector<const MapTiles::Tile*> near_;  // whose objects are painted
};

}  // namespace sslcd
