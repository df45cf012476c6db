// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "loop/cell_lists.h"
#include "loop/layout_point.h"
#include "loop/pair_directions.h"
#include "loop/prefetch.h"

namespace sslcd {

/// The objects of a map by square tiles, only those with objects. Adding and removing an object are
/// O(objects within 25 m) and change the counts of its neighbours' tiles, so the result does not
/// depend on the history.
class MapTiles {
 public:
  static constexpr float kSide = 80.f;  ///< of a tile; set by hand: about one car park [m]

  static constexpr int kGroup = 4;  ///< tiles per side of a group

  struct Tile {
    int number = 0;               ///< from 0 on, in the order of the first objects
    int column = 0, row = 0;      ///< of CellLists
    double left = 0, bottom = 0;  ///< lower left corner [m]
    std::vector<LayoutPoint> points;
    /// pairs of an object of this tile with any other
    pair_directions::Counts pairs{};
  };

  MapTiles() : places_(kSide) {}

  std::size_t tile_count() const { return tiles_.size(); }

  void Add(const LayoutPoint& point);
  /// Removes a point that has been added.
  void Remove(const LayoutPoint& point);

  /// Calls visit(tile) for all tiles, one square of kGroup x kGroup tiles after the other, by row
  /// and column. Some may be empty.
  template <class Visitor>
  void VisitAll(Visitor&& visit) const {
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i + 1 < order_.size()) Prefetch(&tiles_[order_[i + 1]], sizeof(Tile));
      visit(tiles_[order_[i]]);
    }
  }

  /// Calls visit(tile) for the tiles that overlap a box.
  template <class Visitor>
  void VisitBox(double left, double bottom, double right, double top, Visitor&& visit) const {
    const int last_column = places_.Cell(right), last_row = places_.Cell(top);
    for (int row = places_.Cell(bottom); row <= last_row; ++row)
      for (int column = places_.Cell(left); column <= last_column; ++column)
        for (const int i : places_.At(column, row)) visit(tiles_[i]);
  }

 private:
  Tile& TileOf(const LayoutPoint& point);
  void CountPairs(const LayoutPoint& point, Tile& tile, int by);

  CellLists places_;        // indices of tiles by cell
  std::deque<Tile> tiles_;  // in the order of their first object
  std::vector<int> order_;  // their indices in the order of VisitAll()
};

}  // namespace sslcd
