// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sslcd/core/layout.h"

namespace sslcd {

/// Two objects of a layout, labels ascending.
struct ObjectPair {
  int a = 0, b = 0;      ///< indices
  float distance = 0;    ///< horizontal [m]
  float dx = 0, dy = 0;  ///< unit vector from a to b
  float dz = 0;          ///< height of b over a [m]
};

/// The global map, made searchable: which objects lie near a point, and which pairs of objects have a given distance.
class LayoutIndex {
 public:
  /// Objects with a position that is not finite are left out. Pairs are kept up to `max_pair_m`; points find what is
  /// within `reach_m`. O(objects + pairs).
  LayoutIndex(const std::vector<LayoutObject>& objects, double max_pair_m, double reach_m);

  const std::vector<LayoutObject>& objects() const { return objects_; }
  double max_pair() const { return max_pair_; }
  double reach() const { return reach_; }

  /// Indices of the objects within `reach_m` of a point, and a few more.
  struct Range {
    const int *first = nullptr, *last = nullptr;
    const int* begin() const { return first; }
    const int* end() const { return last; }
    bool empty() const { return first == last; }
  };
  Range Near(double x, double y) const;

  /// Is the point among mapped objects, or does it lie beyond the map's rim (no object within 10 to 20 m)?
  bool Known(double x, double y) const;

  /// Pairs of two labels (label_a <= label_b) whose distance may lie in [from_m, to_m]: a superset, by bins.
  std::vector<ObjectPair>::const_iterator PairsBegin(int label_a, int label_b, double from_m) const;
  std::vector<ObjectPair>::const_iterator PairsEnd(int label_a, int label_b, double to_m) const;

  /// Objects per square metre, as seen from an object: the density of its surroundings.
  double density() const { return density_; }
  /// How much the heights of neighbours differ (standard deviation). [m]
  double height_spread() const { return height_spread_; }

 private:
  struct PairTable {
    std::vector<int> start;  // of each distance bin in pairs
    std::vector<ObjectPair> pairs;
  };
  static std::int64_t BlockOf(double x, double y);
  void BuildGrid();
  void BuildPairs();
  int CellOf(double x, double y) const;

  std::vector<LayoutObject> objects_;
  double max_pair_, reach_;
  double cell_ = 1, min_x_ = 0, min_y_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<int> cell_start_, cell_objects_;
  std::map<std::pair<int, int>, PairTable> tables_;
  PairTable none_;
  std::unordered_set<std::int64_t> known_;  // blocks with an object in them or next to them
  double density_ = 0, height_spread_ = 0;
};

}  // namespace sslcd
