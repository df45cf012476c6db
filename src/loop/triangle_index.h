// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "loop/cell_lists.h"
#include "loop/layout_point.h"
#include "loop/sorted_runs.h"

namespace sslcd {

class LayoutIndex;

/// Three objects with a pose-invariant order: vertices by ascending label, those of the same label
/// by ascending length of the opposite side.
struct ObjectTriangle {
  std::array<int, 3> vertex{};  ///< indices
  std::array<float, 3> side{};  ///< horizontal length; side[i] is opposite of vertex[i] [m]
  std::array<int, 3> label{};   ///< ascending

  bool operator==(const ObjectTriangle& o) const {
    return vertex == o.vertex && side == o.side && label == o.label;
  }
  bool operator<(const ObjectTriangle& o) const {
    return std::tie(vertex, side, label) < std::tie(o.vertex, o.side, o.label);
  }
};

/// The triangles of every object with two of its nearest neighbours, each one once. O(n) for a low
/// density.
std::vector<ObjectTriangle> NeighbourTriangles(const LayoutIndex& index);
/// The same for few objects, without an index. O(n^2).
std::vector<ObjectTriangle> NeighbourTriangles(const std::vector<LayoutPoint>& points);

/// The triangles of a large map by labels and sides, sorted. Keeps their corners only, 20 bytes, so
/// that all functions need the index of the map. Exact and deterministic. Building is O(n log n), a
/// search O(log n + found triangles).
class TriangleIndex {
 public:
  explicit TriangleIndex(const LayoutIndex& index);

  /// Adds a point that has been added to the index. Changes about 50 triangles, O(log n) each on
  /// average.
  void Add(const LayoutIndex& index, int added);
  /// Removes a point that has been removed from the index's cells but is still in its points().
  void Remove(const LayoutIndex& index, int removed);

  /// Adds to `found` the triangles whose sides differ by less than `radius_m` (Euclidean norm), in
  /// an order that does not depend on earlier changes. Adds none if there are more than `limit`,
  /// since such a triangle is not distinctive. Of objects that are equally far away, earlier
  /// changes may decide which are neighbours.
  void Find(const LayoutIndex& index, const ObjectTriangle& triangle, double radius_m,
            std::size_t limit, std::vector<ObjectTriangle>& found) const;

  /// Indices of the nearest objects, nearest first; -1: none.
  using Neighbours = std::array<int, 6>;

 private:
  // A triangle in the order of the search: by labels and cells of the first two sides ("column"),
  // then by the last side.
  struct Entry {
    std::uint32_t column : 31;
    std::uint32_t removed : 1;  // of SortedRuns
    float last_side;
    std::array<int, 3> vertex;

    bool operator<(const Entry& o) const {
      if (column != o.column) return column < o.column;
      return last_side != o.last_side ? last_side < o.last_side : vertex < o.vertex;
    }
  };

  static Entry EntryOf(const ObjectTriangle& triangle, bool removed);
  static std::vector<SortedRuns<Entry>::Range> Ranges(const ObjectTriangle& triangle, float radius);
  bool Proposes(int a, int b, int c) const;
  bool IsLonely(const std::vector<LayoutPoint>& points, int a) const;
  std::vector<int> Around(const LayoutIndex& index, int place) const;
  void SetNeighbours(const std::vector<LayoutPoint>& points, int a, const Neighbours& now);

  std::vector<Neighbours> near_;  // of each object, which proposes triangles with two of them
  SortedRuns<Entry> triangles_;
  // Objects with a neighbour beyond the usual distance, or too few of them. Others are affected by
  // changes within this distance only.
  double usual_m_;
  CellLists lonely_;
};

}  // namespace sslcd
