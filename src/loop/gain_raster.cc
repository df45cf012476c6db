// SPDX-License-Identifier: BSD-3-Clause
#include "loop/gain_raster.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sslcd {
namespace {

constexpr int kBlockCells = Correlation::kBlock, kGroup = MapTiles::kGroup;

int RoundUp(int value, int to) { return (value + to - 1) / to * to; }

}  // namespace

GainRaster::GainRaster(const std::vector<LabelGain>& gains, float unit, float reach_m)
    : margin_(RoundUp(static_cast<int>(std::ceil(reach_m / kCell)) + 1, kBlockCells) + kStamp),
      side_(kGroup * Correlation::kSide + 2 * margin_),
      stride_(RoundUp(side_, 16)),
      bound_side_(side_ / kBlockCells + 2),
      bound_stride_(RoundUp(bound_side_ + kStamp, 16)) {
  for (const LabelGain& gain : gains) {
    Layer& layer = layers_.emplace_back();
    layer.label = gain.label;
    const auto most = static_cast<std::uint8_t>(gain.nats / unit + 0.5f);
    for (int blocks = 1; blocks <= kStamp; ++blocks)
      for (int i = 0; i < blocks; ++i) layer.bound_rows[blocks][i] = most;
    layer.cells.resize(static_cast<std::size_t>(side_) * stride_);
    layer.bounds.resize(static_cast<std::size_t>(bound_side_) * bound_stride_);
    for (int phase = 0; phase < kPhases * kPhases; ++phase)
      for (int cell = 0; cell < kStamp * kStamp; ++cell) {
        const auto apart = [](int cells, int phases) {  // the stamp starts 3 cells before its own
          return kCell * (static_cast<float>(cells - 3) + 0.5f -
                          (static_cast<float>(phases) + 0.5f) / kPhases);
        };
        const float dx = apart(cell % kStamp, phase % kPhases),
                    dy = apart(cell / kStamp, phase / kPhases);
        const float nats = gain.nats - (dx * dx + dy * dy) / (2 * kSigma * kSigma);
        const int gain_units = static_cast<int>(nats / unit + 0.5f);
        if (!(nats > 0) || gain_units == 0) continue;
        Stamp& stamp = layer.stamps[phase];
        const int row = cell / kStamp, column = cell % kStamp;
        stamp.rows[row][column] = static_cast<std::uint8_t>(gain_units);
        stamp.bottom = std::min(stamp.bottom, row);
        stamp.top = std::max(stamp.top, row);
        stamp.left = std::min(stamp.left, column);
        stamp.right = std::max(stamp.right, column);
      }
  }
}

void GainRaster::Enter(const MapTiles& map, const MapTiles::Tile& tile) {
  const int column = tile.column % kGroup, row = tile.row % kGroup;
  tile_column_ = margin_ + column * Correlation::kSide;
  tile_row_ = margin_ + row * Correlation::kSide;
  if (group_column_ == tile.column / kGroup && group_row_ == tile.row / kGroup) return;
  group_column_ = tile.column / kGroup;
  group_row_ = tile.row / kGroup;
  Paint(map, tile.left - tile_column_ * static_cast<double>(kCell),
        tile.bottom - tile_row_ * static_cast<double>(kCell));
}

// Paints the objects of the raster that starts at (left, bottom).
void GainRaster::Paint(const MapTiles& map, double left, double bottom) {
  for (Layer& layer : layers_) {
    std::fill(layer.cells.begin(), layer.cells.end(), 0);
    std::fill(layer.bounds.begin(), layer.bounds.end(), 0);
  }
  const double size = side_ * static_cast<double>(kCell);
  map.VisitBox(left, bottom, left + size, bottom + size, [&](const MapTiles::Tile& near) {
    for (const LayoutPoint& p : near.points) {
      const float column = static_cast<float>(p.x - left) / kCell,
                  row = static_cast<float>(p.y - bottom) / kCell;
      // the stamp has to fit
      const float last = static_cast<float>(side_ - kStamp + 3);
      if (!(column >= 3 && column < last && row >= 3 && row < last)) continue;
      for (Layer& layer : layers_)
        if (layer.label == p.label) PaintObject(column, row, layer);
    }
  });
}

void GainRaster::PaintObject(float column, float row, Layer& layer) {
  const int x = static_cast<int>(column), y = static_cast<int>(row);
  const int phase = static_cast<int>((row - static_cast<float>(y)) * kPhases) * kPhases +
                    static_cast<int>((column - static_cast<float>(x)) * kPhases);
  const Stamp& stamp = layer.stamps[phase];
  const int left = x - 3, bottom = y - 3;
  std::uint8_t* const cells = &layer.cells[static_cast<std::size_t>(bottom) * stride_ + left];
  for (int i = stamp.bottom; i <= stamp.top; ++i) Raise(cells + i * stride_, stamp.rows[i]);
  const auto block = [](int cell) { return cell / kBlockCells; };
  const int first = block(left + stamp.left);
  const StampRow& bound = layer.bound_rows[block(left + stamp.right) + 2 - first];
  for (int j = block(bottom + stamp.bottom); j <= block(bottom + stamp.top) + 1; ++j)
    Raise(&layer.bounds[static_cast<std::size_t>(j) * bound_stride_ + first], bound);
}

// The larger of a row of cells and `by`.
void GainRaster::Raise(std::uint8_t* to, const StampRow& by) {
  StampRow now;
  std::memcpy(&now, to, sizeof now);
  now = now > by ? now : by;
  std::memcpy(to, &now, sizeof now);
}

void GainRaster::Append(std::size_t label, float x, float y, ShiftedRasters& rasters) const {
  const int column = static_cast<int>(std::floor(x / kCell + 0.5f)) + tile_column_,
            row = static_cast<int>(std::floor(y / kCell + 0.5f)) + tile_row_;
  const Layer& layer = layers_[label];
  rasters.stride = stride_;
  rasters.bound_stride = bound_stride_;
  rasters.cells[rasters.count] = &layer.cells[static_cast<std::size_t>(row) * stride_ + column];
  rasters.bounds[rasters.count] =
      &layer.bounds[static_cast<std::size_t>(row / kBlockCells + 1) * bound_stride_ +
                    column / kBlockCells + 1];
  ++rasters.count;
}

}  // namespace sslcd
