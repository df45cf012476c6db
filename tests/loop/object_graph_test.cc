// SPDX-License-Identifier: BSD-3-Clause
#include "loop/object_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Vertices = std::map<int, Vec3>;

/// Every other vertex, sorted by distance, then id.
std::vector<GraphEdge> BruteForce(const Vertices& vertices, const Vec3& point, int k,
                                  int without = -1) {
  std::vector<GraphEdge> edges;
  for (const auto& [id, position] : vertices)
    if (id != without) edges.push_back({id, (position - point).norm()});
  std::sort(edges.begin(), edges.end(), [](const GraphEdge& a, const GraphEdge& b) {
    // Equal but for rounding counts as equal.
    const bool equal = std::abs(a.distance_m - b.distance_m) < 1e-9;
    return equal ? a.id < b.id : a.distance_m < b.distance_m;
  });
  edges.resize(std::min<std::size_t>(edges.size(), k));
  return edges;
}

void ExpectEqual(const std::vector<GraphEdge>& edges, const std::vector<GraphEdge>& expected) {
  ASSERT_EQ(edges.size(), expected.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_EQ(edges[i].id, expected[i].id);
    EXPECT_NEAR(edges[i].distance_m, expected[i].distance_m, 1e-12);
  }
}

class Walk {
 public:
  explicit Walk(unsigned seed) : random_(seed) {}
  int Below(int n) { return static_cast<int>(random_() % n); }
  /// On a coarse grid, so that many distances are equal and many points lie on one spot.
  Vec3 GridPoint() { return {1. * Below(12), 2. * Below(6), 0.5 * Below(2)}; }
  Vec3 Point() { return {Below(100000) * 1e-3, Below(100000) * 1e-3, Below(1000) * 1e-3}; }

 private:
  std::mt19937 random_;
};

TEST(ObjectGraph, AgreesWithBruteForceWhileVerticesComeMoveAndLeave) {
  for (const bool grid : {false, true}) {
    Walk walk(grid ? 1 : 2);
    ObjectGraph graph;
    Vertices vertices;
    for (int step = 0; step < 3000; ++step) {
      const int id = walk.Below(600);
      if (walk.Below(4) == 0) {
        graph.Remove(id);
        vertices.erase(id);
      } else {
        const Vec3 p = grid ? walk.GridPoint() : walk.Point();
        graph.Put(id, p);
        vertices[id] = p;
        // right after the addition
        ExpectEqual(graph.Neighbours(id, 5), BruteForce(vertices, p, 5, id));
      }
      if (step % 10 == 0) {
        const Vec3 p = grid ? walk.GridPoint() : walk.Point();
        ExpectEqual(graph.Nearest(p, 7), BruteForce(vertices, p, 7));
      }
      ASSERT_EQ(graph.size(), static_cast<int>(vertices.size()));
      if (HasFatalFailure() || HasNonfatalFailure()) return;
    }
  }
}

TEST(ObjectGraph, DoesNotDependOnTheOrderOfArrival) {
  Walk walk(5);
  Vertices vertices;
  for (int id = 0; id < 300; ++id) vertices[id] = walk.GridPoint();
  ObjectGraph forward, backward;
  for (auto it = vertices.begin(); it != vertices.end(); ++it) forward.Put(it->first, it->second);
  for (auto it = vertices.rbegin(); it != vertices.rend(); ++it)
    backward.Put(it->first, it->second);
  for (const auto& [id, position] : vertices) {
    const auto a = forward.Neighbours(id, 6), b = backward.Neighbours(id, 6);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_EQ(std::tie(a[i].id, a[i].distance_m), std::tie(b[i].id, b[i].distance_m));
  }
}

TEST(ObjectGraph, EmptyOneTwo) {
  ObjectGraph graph;
  EXPECT_EQ(graph.size(), 0);
  EXPECT_TRUE(graph.Neighbours(1, 3).empty());
  EXPECT_TRUE(graph.Nearest(Vec3(0, 0, 0), 3).empty());
  graph.Remove(1);
  graph.Put(-7, Vec3(1, 2, 3));
  EXPECT_TRUE(graph.Contains(-7));
  EXPECT_TRUE(graph.Neighbours(-7, 3).empty());
  graph.Put(9, Vec3(1, 2, 8));
  ExpectEqual(graph.Neighbours(-7, 3), {{9, 5.}});
  ExpectEqual(graph.Neighbours(9, 3), {{-7, 5.}});
  EXPECT_TRUE(graph.Neighbours(9, 0).empty());
  EXPECT_TRUE(graph.Neighbours(9, -1).empty());
  graph.Remove(-7);
  EXPECT_TRUE(graph.Neighbours(9, 3).empty());
  EXPECT_FALSE(graph.Contains(-7));
}

TEST(ObjectGraph, ManyOnOneSpotAreAllThere) {
  ObjectGraph graph;
  for (int id = 0; id < 200; ++id) graph.Put(id, Vec3(4, 4, 4));
  for (const int id : {0, 2, 100, 199}) {
    const std::vector<GraphEdge> edges = graph.Neighbours(id, 3);
    ASSERT_EQ(edges.size(), 3u);
    int expected = 0;
    for (const GraphEdge& edge : edges) {
      if (expected == id) ++expected;
      EXPECT_EQ(edge.id, expected++);
      EXPECT_EQ(edge.distance_m, 0);
    }
  }
  EXPECT_EQ(graph.Neighbours(5, 1000).size(), 199u);
}

TEST(ObjectGraph, PositionsThatAreNotFiniteAreRefused) {
  ObjectGraph graph;
  graph.Put(1, Vec3(0, 0, 0));
  EXPECT_THROW(graph.Put(2, Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0)), Error);
  EXPECT_THROW(graph.Put(1, Vec3(std::numeric_limits<double>::infinity(), 0, 0)), Error);
  EXPECT_EQ(graph.size(), 1);
  EXPECT_TRUE(graph.Contains(1)) << "where it was";
  EXPECT_TRUE(graph.Nearest(Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0), 1).empty());
}

TEST(ObjectGraph, CanBeMovedTo) {
  ObjectGraph graph;
  graph.Put(1, Vec3(0, 0, 0));
  ObjectGraph other = std::move(graph);
  EXPECT_TRUE(other.Contains(1));
}

}  // namespace
}  // namespace sslcd
