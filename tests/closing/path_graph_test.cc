// SPDX-License-Identifier: BSD-3-Clause
#include "closing/path_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/random.h"

namespace sslcd {
namespace {

TEST(PathGraph, WithoutShortcutsItIsThePath) {
  const PathGraph graph;
  const PathGraph::Distances distances = graph.From(100);
  EXPECT_EQ(distances.To(100), 0);
  EXPECT_EQ(distances.To(30), 70);
  EXPECT_EQ(distances.To(250), 150);
}

TEST(PathGraph, AShortcutBringsItsSurroundingsNear) {
  PathGraph graph;
  graph.AddShortcut(100, 900);
  EXPECT_EQ(graph.From(900).To(100), 0);
  EXPECT_EQ(graph.From(100).To(900), 0);
  EXPECT_EQ(graph.From(920).To(95), 25);
  EXPECT_EQ(graph.From(880).To(130), 50);
  EXPECT_EQ(graph.From(910).To(905), 5) << "the direct way where that is shorter";
  EXPECT_EQ(graph.From(600).To(400), 200);
  EXPECT_EQ(graph.From(0).To(1000), 200);
}

TEST(PathGraph, WaysMayUseManyShortcutsAndShareTheirEnds) {
  PathGraph graph;
  graph.AddShortcut(0, 1000);
  graph.AddShortcut(1010, 2000);
  graph.AddShortcut(2000, 3000);
  graph.AddShortcut(3000, 3000);  // nonsense does no harm
  graph.AddShortcut(0, 1000);
  EXPECT_EQ(graph.From(3005).To(2), 5 + 10 + 2);
  EXPECT_EQ(graph.From(2).To(3005), 17);
}

TEST(PathGraph, AgreesWithTheShortestOfAllWays) {
  sim::Random random(3);
  for (int round = 0; round < 20; ++round) {
    PathGraph graph;
    // from, to, then pairs of shortcuts
    std::vector<double> ends{random.Uniform(0, 1000), random.Uniform(0, 1000)};
    for (int i = 0; i < 8; ++i) {
      ends.push_back(random.Uniform(0, 1000));
      ends.push_back(random.Uniform(0, 1000));
      graph.AddShortcut(ends[ends.size() - 2], ends.back());
    }
    const int n = static_cast<int>(ends.size());
    std::vector<std::vector<double>> way(n, std::vector<double>(n));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        way[i][j] = i > 1 && i / 2 == j / 2 ? 0. : std::abs(ends[i] - ends[j]);
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) way[i][j] = std::min(way[i][j], way[i][k] + way[k][j]);
    EXPECT_NEAR(graph.From(ends[0]).To(ends[1]), way[0][1], 1e-9) << "round " << round;
    EXPECT_NEAR(graph.From(ends[1]).To(ends[0]), way[0][1], 1e-9) << "round " << round;
  }
}

}  // namespace
}  // namespace sslcd
