// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "loop/cell_lists.h"
#include "loop/pair_index.h"
#include "loop/triangle_index.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// What scoring a pose has to know about an object.
struct LayoutPoint {
  float x = 0, y = 0, z = 0;  ///< [m]
  int label = 0;
};

/// The global map, made searchable: which objects lie near a point, and where a few objects of a
/// given arrangement are. Small maps list all pairs of objects by distance; those with more than 50
/// 000 pairs have the triangles of neighbours in k-d trees instead.
class LayoutIndex {
 public:
  /// Objects with a position that is not finite are left out. Pairs are kept up to `max_pair_m`;
  /// points find what is within `reach_m`. O(objects + pairs) for small maps, O(n log n) for large
  /// ones.
  LayoutIndex(std::vector<LayoutObject> objects, double max_pair_m, double reach_m);

  /// Objects have come, have changed, or (`removed`, ids) are gone. No two objects may have one id;
  /// one that is not known is ignored in `removed`. Then answers as an index built of the objects
  /// as they are now, in another order; indices may be others than before, and of neighbours
  /// equally far either may count. In a large map this costs O(log^2 n) on average for each object
  /// that has come, moved or gone. A small one, or one of which more than one object in 32 has
  /// changed, is built anew, ordered by id; until then, a map that was large counts as large.
  void Update(const std::vector<LayoutObject>& changed, const std::vector<int>& removed);

  const std::vector<LayoutObject>& objects() const { return objects_; }
  const std::vector<LayoutPoint>& points() const { return points_; }
  double max_pair() const { return max_pair_; }
  double reach() const { return reach_; }

  /// Indices of the objects within `reach_m` of a point, and a few more.
  CellLists::Range Near(double x, double y) const {
    if (!std::isfinite(x) || !std::isfinite(y)) return near_.None();
    return near_.At(near_.Cell(x), near_.Cell(y));
  }

  /// Calls visit(index) for the objects in a box, and for a few more. O(blocks of 10 m + objects
  /// visited), and never more than O(objects).
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

  /// Is the point among mapped objects, or does it lie beyond the map's rim (no object within 10 to
  /// 20 m)?
  bool Known(double x, double y) const;

  /// Pairs by labels and distance; none in large maps.
  const PairIndex& pairs() const { return pairs_; }

  /// Triangles of neighbours; null in small maps, which have pairs.
  const TriangleIndex* triangles() const { return triangles_ ? &*triangles_ : nullptr; }

  /// Objects per square metre, as seen from an object: the density of its surroundings.
  double density() const { return density_; }
  /// Volume of the poses that put a point among the objects: their area times all headings.
  /// [m^2 rad]
  double pose_volume() const;
  /// How much the heights of neighbours differ (standard deviation). [m]
  double height_spread() const { return height_spread_; }

  /// How many objects have a label.
  const std::map<int, int>& label_counts() const { return label_counts_; }

  /// How many objects head into each direction, bins of one degree from 0 on; [0] of no symmetry,
  /// [1] of a half turn.
  using Headings = std::array<std::array<int, 360>, 2>;
  const Headings& headings() const { return headings_; }

 private:
  void Build();
  struct Change;  // what an update has touched
  void Remove(int id, Change& change);
  void Put(const LayoutObject& object, Change& change);
  void Count(int object, int by);
  void Enter(int object);
  void Leave(int object);
  void CountNeighbours(int object, int by);
  void Judge();

  std::vector<LayoutObject> objects_;
  std::vector<LayoutPoint> points_;
  std::unordered_map<int, int> index_of_;  // id -> index; filled by the first update
  double max_pair_, reach_;
  // each object once; each object in every cell that its reach touches
  CellLists blocks_, near_;
  PairIndex pairs_;
  std::optional<TriangleIndex> triangles_;
  // pairs of objects in each other's surroundings; whole numbers, so that any order of updates adds
  // up to the same
  std::int64_t neighbours_ = 0, height_sum_ = 0;
  double density_ = 0, height_spread_ = 0;
  std::map<int, int> label_counts_;
  Headings headings_{};
};

}  // namespace sslcd
