// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// An edge of the object graph, seen from one of its ends. Paper Eq. 9: e_edge = |t(T_wo1^-1
/// T_wo2)|, the distance between the two centres.
struct GraphEdge {
  int id = -1;  ///< the vertex at the other end
  double distance_m = 0;
};

/// The graph G = (V, E) of the paper's IV-A with incremental updates: a vertex per object, and an
/// edge to each of its K nearest neighbours. Edges are searched on demand, since one new object may
/// change those of many others.
/// Neighbours are exact (FLANN k-d trees). Additions and searches cost O(log^2 n) on average.
/// Answers depend on the set of vertices, not on the order of their addition. Not thread-safe.
class ObjectGraph {
 public:
  ObjectGraph();
  ~ObjectGraph();
  ObjectGraph(ObjectGraph&&) noexcept;
  ObjectGraph& operator=(ObjectGraph&&) noexcept;

  /// Adds or moves vertex `id`, which may be any number. Throws Error (kBadInput) if the position
  /// is not finite.
  void Put(int id, const Vec3& position);

  /// Does nothing if there is no such vertex.
  void Remove(int id);

  /// Edges to the `k` nearest other vertices, nearest first, equal distances by ascending id. Fewer
  /// if the graph has fewer; none for an unknown vertex or k <= 0.
  std::vector<GraphEdge> Neighbours(int id, int k) const;

  /// The same for any finite point. A vertex at the point also counts.
  std::vector<GraphEdge> Nearest(const Vec3& point, int k) const;

  bool Contains(int id) const;
  int size() const;

 private:
  struct Vertices;
  std::unique_ptr<Vertices> vertices_;
};

}  // namespace sslcd
