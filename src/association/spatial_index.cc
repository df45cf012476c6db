// SPDX-License-Identifier: BSD-3-Clause
#include "association/spatial_index.h"

#include <algorithm>
#include <cmath>

namespace sslcd {

std::int64_t SpatialIndex::Index(double coordinate) const {
  const double index = std::floor(coordinate / cell_m_);
  constexpr double kFar = 1e18;  // what is there, or nowhere, shares a cell
  return static_cast<std::int64_t>(std::abs(index) < kFar ? index : kFar);
}

std::int64_t SpatialIndex::CellOf(std::int64_t column, std::int64_t row) const {
  return static_cast<std::int64_t>((static_cast<std::uint64_t>(column) << 32) ^
                                   (static_cast<std::uint64_t>(row) & 0xffffffffu));
}

void SpatialIndex::Put(int id, double x, double y) {
  const std::int64_t cell = CellOf(Index(x), Index(y));
  const auto known = place_.find(id);
  if (known != place_.end()) {
    if (known->second.cell == cell) {
      known->second = {x, y, cell};
      return;
    }
    Remove(id);
  }
  place_[id] = {x, y, cell};
  cells_[cell].push_back(id);
}

void SpatialIndex::Remove(int id) {
  const auto known = place_.find(id);
  if (known == place_.end()) return;
  const auto cell = cells_.find(known->second.cell);
  auto& ids = cell->second;
  ids.erase(std::find(ids.begin(), ids.end(), id));
  if (ids.empty()) cells_.erase(cell);
  place_.erase(known);
}

std::vector<int> SpatialIndex::FindWithin(double x, double y, double radius_m) const {
  std::vector<int> found;
  const auto take = [&](int id, const Entry& entry) {
    if (std::hypot(entry.x - x, entry.y - y) <= radius_m) found.push_back(id);
  };
  // Of more cells than entries, most are empty; a radius without bound has no end of them.
  const double side = 2 * radius_m / cell_m_ + 1;
  if (!(side * side <= 64. + static_cast<double>(place_.size()))) {
    for (const auto& [id, entry] : place_) take(id, entry);
  } else {
    for (std::int64_t column = Index(x - radius_m); column <= Index(x + radius_m); ++column)
      for (std::int64_t row = Index(y - radius_m); row <= Index(y + radius_m); ++row) {
        const auto cell = cells_.find(CellOf(column, row));
        if (cell == cells_.end()) continue;
        for (const int id : cell->second) take(id, place_.at(id));
      }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace sslcd
