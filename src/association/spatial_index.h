// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sslcd {

/// Hash grid over the horizontal plane. The cost of a search depends only on the number of objects
/// near the point, not on the size of the map. Not thread-safe.
class SpatialIndex {
 public:
  explicit SpatialIndex(double cell_m = 10.) : cell_m_(cell_m) {}

  /// Inserts or moves `id`. Coordinates in metres.
  void Put(int id, double x, double y);
  void Remove(int id);

  /// Ids within `radius_m` of the point in ascending order, so that callers are deterministic.
  std::vector<int> FindWithin(double x, double y, double radius_m) const;

  std::size_t size() const { return place_.size(); }

 private:
  struct Entry {
    double x, y;
    std::int64_t cell;
  };
  std::int64_t CellOf(std::int64_t column, std::int64_t row) const;
  std::int64_t Index(double coordinate) const;

  double cell_m_;
  std::unordered_map<int, Entry> place_;
  std::unordered_map<std::int64_t, std::vector<int>> cells_;
};

}  // namespace sslcd
