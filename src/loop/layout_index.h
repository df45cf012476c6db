// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "loop/cell_lists.h"
#include "loop/layout_counts.h"
#include "loop/layout_point.h"
#include "loop/map_tiles.h"
#include "loop/pair_index.h"
#include "loop/triangle_index.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// A search index of the global map: objects near a point, and places with a given arrangement of
/// objects. Small maps have lists of all object pairs by distance. Maps with more than 50 000 pairs
/// have tiles with counts of their pairs, and the triangles of neighbours, instead: less than 1 KiB
/// per object.
class LayoutIndex {
 public:
  /// Ignores objects whose position is not finite. Keeps pairs up to `max_pair_m`;
  /// FindWithinReach() finds objects within `reach_m`. O(objects + pairs) for small maps, O(n log
  /// n) for large ones.
  LayoutIndex(std::vector<LayoutObject> objects, double max_pair_m, double reach_m);

  /// Adds or replaces the `changed` objects and removes those with the ids `removed`. Ids must be
  /// unique; unknown ids in `removed` are ignored. The result equals a new index of the current
  /// objects in another order: indices may change, and on a tie another neighbour may count. In a
  /// large map this costs O(log n) on average per object. A small map, or one with more than one
  /// changed object in 32, is rebuilt and ordered by id; a map that was large counts as large until
  /// then.
  void Update(const std::vector<LayoutObject>& changed, const std::vector<int>& removed);

  const std::vector<LayoutObject>& objects() const { return objects_; }
  const std::vector<LayoutPoint>& points() const { return points_; }
  double max_pair() const { return max_pair_; }
  double reach() const { return reach_; }

  /// Indices of the objects within `reach_m` of a point, and of a few farther ones.
  CellLists::Range FindWithinReach(double x, double y) const {
    if (!std::isfinite(x) || !std::isfinite(y)) return near_.None();
    return near_.At(near_.Cell(x), near_.Cell(y));
  }

  /// Calls visit(index) for the objects in a box, and for a few outside of it. O(blocks of 10 m +
  /// visited objects), at most O(objects).
  template <class Visitor>
  void VisitBox(const Vec2& low, const Vec2& high, Visitor&& visit) const {
    if (!low.allFinite() || !high.allFinite()) return;
    const int left = blocks_.Cell(low.x()), right = blocks_.Cell(high.x());
    const int bottom = blocks_.Cell(low.y()), top = blocks_.Cell(high.y());
    if (right < left || top < bottom) return;
    if ((right - left + 1.) * (top - bottom + 1.) > static_cast<double>(objects_.size())) {
      for (int i = 0; i < static_cast<int>(objects_.size()); ++i) {
        const int column = blocks_.Cell(objects_[i].position.x()),
                  row = blocks_.Cell(objects_[i].position.y());
        if (column >= left && column <= right && row >= bottom && row <= top) visit(i);
      }
      return;
    }
    for (int column = left; column <= right; ++column)
      for (int row = bottom; row <= top; ++row)
        for (const int i : blocks_.At(column, row)) visit(i);
  }

  /// Whether the point is inside the mapped area: there is an object within 10 to 20 m.
  /// Ignores objects whose LayoutObject::since_m is not before `end_m`.
  bool IsMapped(double x, double y, double end_m = std::numeric_limits<double>::infinity()) const;
  /// A number of the block of a finite point: IsMapped() is the same in all of it.
  std::uint64_t BlockOf(double x, double y) const {
    return static_cast<std::uint64_t>(blocks_.Cell(x)) << 32 |
           static_cast<std::uint64_t>(blocks_.Cell(y));
  }

  /// Pairs by labels and distance; none in large maps.
  const PairIndex& pairs() const { return pairs_; }

  /// Triangles of neighbours; null in small maps, which have pairs instead.
  const TriangleIndex* triangles() const { return triangles_ ? &*triangles_ : nullptr; }

  /// Objects by tiles; null in small maps.
  const MapTiles* tiles() const { return tiles_ ? &*tiles_ : nullptr; }

  /// Mean density of objects around an object. [1/m^2]
  double density() const { return density_; }
  /// Volume of the poses that map a point into the area of the objects: this area times all
  /// headings. [m^2 rad]
  double pose_volume() const;
  /// Standard deviation of the height differences of neighbours. [m]
  double height_spread() const { return height_spread_; }

  /// Frequencies of labels and headings.
  const LayoutCounts& counts() const { return counts_; }

 private:
  void Build();
  void Remove(int id, bool rebuild);
  void Put(const LayoutObject& object, bool rebuild);
  void InsertIntoCells(int object);
  void RemoveFromCells(int object);
  void CountNeighbours(int object, int by);
  void UpdateDensity();

  std::vector<LayoutObject> objects_;
  std::vector<LayoutPoint> points_;
  std::unordered_map<int, int> index_of_;  // index by id; filled by the first update
  double max_pair_, reach_;
  // blocks_ has each object once; near_ has it in every cell within its reach
  CellLists blocks_, near_;
  PairIndex pairs_;
  std::optional<TriangleIndex> triangles_;
  std::optional<MapTiles> tiles_;
  // pairs of neighbouring objects; integers, so that the order of updates does not change the sums
  std::int64_t neighbours_ = 0, height_sum_ = 0;
  double density_ = 0, height_spread_ = 0;
  LayoutCounts counts_;
};

}  // namespace sslcd
