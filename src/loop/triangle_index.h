// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <tuple>
#include <vector>

#include "sslcd/core/layout.h"

namespace sslcd {

class LayoutIndex;
struct LayoutPoint;

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

/// The triangles of a large map by labels and sides: forests of FLANN k-d trees over the three
/// sides, one per triple of labels. Exact and thus deterministic. Building is O(n log n), a search
/// O(log n + found triangles).
class TriangleIndex {
 public:
  explicit TriangleIndex(const LayoutIndex& index);
  TriangleIndex(const TriangleIndex& other);  ///< O(n log n): rebuilds the trees
  TriangleIndex& operator=(const TriangleIndex& other) { return *this = TriangleIndex(other); }
  TriangleIndex(TriangleIndex&&) noexcept;
  TriangleIndex& operator=(TriangleIndex&&) noexcept;
  ~TriangleIndex();

  /// Updates the triangles after changes of the points at `changed` indices (old or new ones) of
  /// its index. An object belongs to about 30 triangles: O(log^2 n) on average.
  void Update(const LayoutIndex& index, std::vector<int> changed);

  /// Adds to `found` the triangles whose sides differ by less than `radius_m` (Euclidean norm), in
  /// an unspecified but deterministic order. Adds none if there are more than `limit`, since such a
  /// triangle is not distinctive. Pointers are valid until the next update.
  void Find(const ObjectTriangle& triangle, double radius_m, std::size_t limit,
            std::vector<const ObjectTriangle*>& found) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sslcd
