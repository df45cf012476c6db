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

/// Three objects. Its signature is known again wherever it stands: vertices by ascending label,
/// those of one label by ascending length of the side opposite.
struct ObjectTriangle {
  std::array<int, 3> vertex{};  ///< indices
  std::array<float, 3> side{};  ///< horizontal, side[i] opposite of vertex[i] [m]
  std::array<int, 3> label{};   ///< ascending

  bool operator==(const ObjectTriangle& o) const {
    return vertex == o.vertex && side == o.side && label == o.label;
  }
  bool operator<(const ObjectTriangle& o) const {
    return std::tie(vertex, side, label) < std::tie(o.vertex, o.side, o.label);
  }
};

/// The triangles of every object with two of its nearest neighbours, each once. O(n) for few
/// objects per square metre.
std::vector<ObjectTriangle> NeighbourTriangles(const LayoutIndex& index);
/// The same for few objects, without an index. O(n^2).
std::vector<ObjectTriangle> NeighbourTriangles(const std::vector<LayoutPoint>& points);

/// The triangles of a large map by signature: forests of FLANN k-d trees over the three sides, one
/// for each triple of labels. Exact, so deterministic. Building is O(n log n), a look-up O(log n +
/// triangles found).
class TriangleIndex {
 public:
  explicit TriangleIndex(const LayoutIndex& index);
  TriangleIndex(const TriangleIndex& other);  ///< O(n log n): its trees are built again
  TriangleIndex& operator=(const TriangleIndex& other) { return *this = TriangleIndex(other); }
  TriangleIndex(TriangleIndex&&) noexcept;
  TriangleIndex& operator=(TriangleIndex&&) noexcept;
  ~TriangleIndex();

  /// Follows the index it was made of, whose points at `changed` indices (old ones or new ones) are
  /// not what they were. An object has a part in some 30 triangles, which become others when it
  /// comes or goes: O(log^2 n) on average.
  void Update(const LayoutIndex& index, std::vector<int> changed);

  /// Adds to `found` the triangles whose sides differ by less than `radius_m` (Euclidean norm), in
  /// no particular but always the same order. More than `limit`: none, such a triangle says
  /// nothing. Pointers hold until the next update.
  void Find(const ObjectTriangle& triangle, double radius_m, std::size_t limit,
            std::vector<const ObjectTriangle*>& found) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sslcd
