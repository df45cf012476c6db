// SPDX-License-Identifier: BSD-3-Clause
#include "loop/gain_raster.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "loop/prefetch.h"

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
      bound_stride_(RoundUp(bound_side_ + kStamp, 16)),
      cells_(gains.size() * CellsOfLayer()),
      bounds_(gains.size() * BoundsOfLayer()) {
  for (const LabelGain& gain : gains) {
    Layer& layer = layers_.emplace_back();
    layer.label = gain.label;
    const auto most = static_cast<std::uint8_t>(gain.nats / unit + 0.5f);
    for (int blocks = 1; blocks <= kStamp; ++blocks)
      for (int i = 0; i < blocks; ++i) layer.bound_rows[blocks][i] = most;
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
  tile_column_ = tile.column % kGroup;
  tile_row_ = tile.row % kGroup;
  if (group_column_ == tile.column / kGroup && group_row_ == tile.row / kGroup) return;
  group_column_ = tile.column / kGroup;
  group_row_ = tile.row / kGroup;
  const double margin = margin_ * static_cast<double>(kCell), side = MapTiles::kSide;
  Paint(map, tile.left - side * tile_column_ - margin, tile.bottom - side * tile_row_ - margin);
}

// Paints the objects of the raster that starts at (left, bottom).
void GainRaster::Paint(const MapTiles& map, double left, double bottom) {
  std::fill(cells_.begin(), cells_.end(), 0);
  std::fill(bounds_.begin(), bounds_.end(), 0);
  const double size = side_ * static_cast<double>(kCell);
  near_.clear();
  map.VisitBox(left, bottom, left + size, bottom + size, [&](const MapTiles::Tile& tile) {
    Prefetch(&tile.points, sizeof tile.points);
    near_.push_back(&tile);
  });
  const float last = static_cast<float>(side_ - kStamp + 3);  // the stamp has to fit
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const std::vector<LayoutPoint>& next = near_[std::min(i + 2, near_.size() - 1)]->points;
    Prefetch(next.data(), next.size() * sizeof next[0]);
    for (const LayoutPoint& p : near_[i]->points) {
      const float column = static_cast<float>(p.x - left) / kCell,
                  row = static_cast<float>(p.y - bottom) / kCell;
      if (!(column >= 3 && column < last && row >= 3 && row < last)) continue;
      for (std::size_t layer = 0; layer < layers_.size(); ++layer)
        if (layers_[layer].label == p.label) PaintObject(column, row, layer);
    }
  }
}

void GainRaster::PaintObject(float column, float row, std::size_t layer) {
  const int x = static_cast<int>(column), y = static_cast<int>(row);
  const int phase = static_cast<int>((row - static_cast<float>(y)) * kPhases) * kPhases +
                    static_cast<int>((column - static_cast<float>(x)) * kPhases);
  const Stamp& stamp = layers_[layer].stamps[phase];
  const int left = x - 3, bottom = y - 3;
  std::uint8_t* const cells = &cells_[layer * CellsOfLayer() + bottom * stride_ + left];
  for (int i = stamp.bottom; i <= stamp.top; ++i) Raise(cells + i * stride_, stamp.rows[i]);
  const auto block = [](int cell) { return cell / kBlockCells; };
  const int first = block(left + stamp.left), end = block(left + stamp.right) + 2;
  std::uint8_t* const bounds = &bounds_[layer * BoundsOfLayer() + first];
  for (int j = block(bottom + stamp.bottom); j < block(bottom + stamp.top) + 2; ++j)
    Raise(bounds + j * bound_stride_, layers_[layer].bound_rows[end - first]);
}

// The larger of a row of cells and `by`.
void GainRaster::Raise(std::uint8_t* to, const StampRow& by) {
  StampRow now;
  std::memcpy(&now, to, sizeof now);
  now = now > by ? now : by;
  std::memcpy(to, &now, sizeof now);
}

Rasters GainRaster::FromTile() const {
  constexpr int kBlocks = Correlation::kSide / kBlockCells;
  return {&cells_[Correlation::kSide * (tile_row_ * stride_ + tile_column_)],
          &bounds_[kBlocks * (tile_row_ * bound_stride_ + tile_column_)], stride_, bound_stride_};
}

void GainRaster::Append(std::size_t label, float x, float y, RasterShifts& shifts) const {
  const int column = static_cast<int>(std::floor(x / kCell + 0.5f)) + margin_,
            row = static_cast<int>(std::floor(y / kCell + 0.5f)) + margin_;
  const int layer = static_cast<int>(label);
  shifts.cells[shifts.count] = layer * CellsOfLayer() + row * stride_ + column;
  shifts.bounds[shifts.count] =
      layer * BoundsOfLayer() + (row / kBlockCells + 1) * bound_stride_ + column / kBlockCells + 1;
  ++shifts.count;
}

}  // namespace sslcd
