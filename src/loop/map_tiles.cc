// SPDX-License-Identifier: BSD-3-Clause
#include "loop/map_tiles.h"

#include <algorithm>
#include <tuple>

namespace sslcd {
namespace {

constexpr int kMiddleCell = 1 << 29;  // the cell of CellLists that starts at 0

}  // namespace

MapTiles::Tile& MapTiles::TileOf(const LayoutPoint& point) {
  const int column = places_.Cell(point.x), row = places_.Cell(point.y);
  for (const int i : places_.At(column, row)) return tiles_[i];
  const int number = static_cast<int>(tiles_.size());
  Tile& tile = tiles_.emplace_back();
  tile.number = number;
  tile.column = column;
  tile.row = row;
  tile.left = static_cast<double>(kSide) * (column - kMiddleCell);
  tile.bottom = static_cast<double>(kSide) * (row - kMiddleCell);
  places_.Add(column, row, number);
  const auto rank = [this](int i) {
    const Tile& t = tiles_[i];
    return std::make_tuple(t.row / kGroup, t.column / kGroup, t.row, t.column);
  };
  const auto before = [&](int a, int b) { return rank(a) < rank(b); };
  order_.insert(std::lower_bound(order_.begin(), order_.end(), number, before), number);
  return tile;
}

void MapTiles::Add(const LayoutPoint& point) {
  Tile& tile = TileOf(point);
  CountPairs(point, tile, 1);
  tile.points.push_back(point);
}

void MapTiles::Remove(const LayoutPoint& point) {
  Tile& tile = TileOf(point);
  const auto at = std::find_if(tile.points.begin(), tile.points.end(), [&](const LayoutPoint& p) {
    return p.x == point.x && p.y == point.y && p.z == point.z && p.label == point.label;
  });
  *at = tile.points.back();
  tile.points.pop_back();
  CountPairs(point, tile, -1);
}

// Counts the pairs of a point that is not in its tile.
void MapTiles::CountPairs(const LayoutPoint& point, Tile& tile, int by) {
  constexpr float kReach = pair_directions::kFarthest;
  const auto count = [by](std::uint16_t& pairs) {
    pairs = static_cast<std::uint16_t>(pairs + by);  // modulo 2^16: removing undoes adding
  };
  const int left = places_.Cell(point.x - kReach), right = places_.Cell(point.x + kReach),
            bottom = places_.Cell(point.y - kReach), top = places_.Cell(point.y + kReach);
  for (int row = bottom; row <= top; ++row)
    for (int column = left; column <= right; ++column)
      for (const int i : places_.At(column, row))
        for (const LayoutPoint& p : tiles_[i].points) {
          const int bin = pair_directions::Bin(p.x - point.x, p.y - point.y);
          if (bin < 0) continue;
          count(tile.pairs[bin]);
          count(tiles_[i].pairs[bin]);
        }
}

}  // namespace sslcd
