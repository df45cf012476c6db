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

/// The graph G = (V, E) of the paper's IV-A, kept up to date as objects come, move and leave: a
/// vertex per object, an edge to each of its K nearest neighbours. The edges are not stored but
/// looked up, since one new object may change those of many others.
///
/// Neighbours are exact (FLANN k-d trees). Adding costs O(log^2 n) on average and a look-up about
/// as much, right after an addition too. Answers depend on which vertices there are, not on the
/// order they came in. Not thread-safe.
class ObjectGraph {
 public:
  ObjectGraph();
  ~ObjectGraph();
  ObjectGraph(ObjectGraph&&) noexcept;
  ObjectGraph& operator=(ObjectGraph&&) noexcept;

  /// Adds vertex `id`, or moves it. Any id is fine. Throws Error (kBadInput) if the position is not
  /// finite.
  void Put(int id, const Vec3& position);

  /// Does nothing if there is no such vertex.
  void Remove(int id);

  /// Edges to the `k` nearest other vertices, nearest first, equal distances by ascending id. Fewer
  /// if the graph has fewer; none for an unknown vertex or k <= 0.
  std::vector<GraphEdge> Neighbours(int id, int k) const;

  /// The same from any finite point; a vertex that lies there counts too.
  std::vector<GraphEdge> Nearest(const Vec3& point, int k) const;

  bool Contains(int id) const;
  int size() const;

 private:
  struct Vertices;
  std::unique_ptr<Vertices> vertices_;
};

}  // namespace sslcd
