// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <vector>

#include "sslcd/core/layout.h"

namespace sslcd {

class TriangleIndex;

/// Two objects of a layout, labels ascending.
struct ObjectPair {
  int a = 0, b = 0;      ///< indices
  float distance = 0;    ///< horizontal [m]
  float dx = 0, dy = 0;  ///< unit vector from a to b
  float dz = 0;          ///< height of b over a [m]
};

/// What scoring a pose has to know about an object.
struct LayoutPoint {
  float x = 0, y = 0, z = 0;  ///< [m]
  int label = 0;
};

/// The global map, made searchable: which objects lie near a point, and where a few objects of a given arrangement are.
/// Small maps list all pairs of objects by distance; those with more than 50 000 pairs have the triangles of neighbours
/// in k-d trees instead.
class LayoutIndex {
 public:
  /// Objects with a position that is not finite are left out. Pairs are kept up to `max_pair_m`; points find what is
  /// within `reach_m`. O(objects + pairs) for small maps, O(n sqrt(n)) with a tiny factor for large ones.
  LayoutIndex(std::vector<LayoutObject> objects, double max_pair_m, double reach_m);

  const std::vector<LayoutObject>& objects() const { return objects_; }
  const std::vector<LayoutPoint>& points() const { return points_; }
  double max_pair() const { return max_pair_; }
  double reach() const { return reach_; }

  /// Indices of the objects within `reach_m` of a point, and a few more.
  struct Range {
    const int *first = nullptr, *last = nullptr;
    const int* begin() const { return first; }
    const int* end() const { return last; }
    bool empty() const { return first == last; }
  };
  Range Near(double x, double y) const {
    const double column = (x - min_x_) * per_cell_, row = (y - min_y_) * per_cell_;
    if (!(column >= 0 && column < columns_ && row >= 0 && row < rows_)) return {};
    const int cell = static_cast<int>(row) * columns_ + static_cast<int>(column);
    return {cell_objects_.data() + cell_start_[cell], cell_objects_.data() + cell_start_[cell + 1]};
  }

  /// Calls visit(index) for the objects in a box, and for a few more. O(columns of 10 m + objects visited).
  template <class Visitor>
  void VisitBox(const Vec2& low, const Vec2& high, Visitor&& visit) const {
    if (!low.allFinite() || !high.allFinite()) return;
    const int bottom = Block(low.y()), top = Block(high.y());
    const int left = std::max(Block(low.x()), first_column_), right = std::min(Block(high.x()), last_column_);
    for (int column = left; column <= right; ++column)
      for (auto it = FirstInBlock(column, bottom), end = FirstInBlock(column, top + 1); it != end; ++it)
        visit(it->object);
  }

  /// Is the point among mapped objects, or does it lie beyond the map's rim (no object within 10 to 20 m)?
  bool Known(double x, double y) const;

  /// Pairs of two labels (label_a <= label_b) whose distance may lie in [from_m, to_m]: a superset, by bins; of more
  /// than 256 labels, the rarer ones may share a list. None in large maps.
  std::vector<ObjectPair>::const_iterator PairsBegin(int label_a, int label_b, double from_m) const;
  std::vector<ObjectPair>::const_iterator PairsEnd(int label_a, int label_b, double to_m) const;

  /// Triangles of neighbours; null in small maps, which have pairs.
  const TriangleIndex* triangles() const { return triangles_.get(); }

  /// Objects per square metre, as seen from an object: the density of its surroundings.
  double density() const { return density_; }
  /// How much the heights of neighbours differ (standard deviation). [m]
  double height_spread() const { return height_spread_; }

  /// How many objects have a label.
  const std::map<int, int>& label_counts() const { return label_counts_; }

  /// How many objects head into each direction, bins of one degree from 0 on; [0] of no symmetry, [1] of a half turn.
  using Headings = std::array<std::array<int, 360>, 2>;
  const Headings& headings() const { return headings_; }

 private:
  struct InBlock {
    int column, row, object;
    bool operator<(const InBlock& o) const {
      return column != o.column ? column < o.column : row != o.row ? row < o.row : object < o.object;
    }
  };
  static int Block(double coordinate);
  std::vector<InBlock>::const_iterator FirstInBlock(int column, int row) const;  // of this block or a later one
  void CountProperties();
  void BuildBlocks();
  void BuildGrid();
  void BuildPairs();
  void SortPairs(const std::vector<ObjectPair>& found);
  int LabelRank(int label) const;
  int PairSlot(int label_a, int label_b, double distance_m) const;

  std::vector<LayoutObject> objects_;
  std::vector<LayoutPoint> points_;
  double max_pair_, reach_;
  std::vector<InBlock> blocks_;  // each object once, by column, then row of blocks
  int first_column_ = 0, last_column_ = -1, first_row_ = 0, block_rows_ = 0;
  std::vector<int> block_start_;  // of each block in blocks_; empty where the map has next to nothing but gaps
  double per_cell_ = 1, min_x_ = 0, min_y_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<int> cell_start_, cell_objects_;
  std::vector<int> labels_;      // ascending
  int bins_ = 0;                 // of distance
  std::vector<int> pair_start_;  // of each slot (label, label, distance) in pairs_
  std::vector<ObjectPair> pairs_;
  std::shared_ptr<const TriangleIndex> triangles_;
  double density_ = 0, height_spread_ = 0;
  std::map<int, int> label_counts_;
  Headings headings_{};
};

}  // namespace sslcd
