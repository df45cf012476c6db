// SPDX-License-Identifier: BSD-3-Clause
#include "loop/layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sslcd {
namespace {

TEST(LayoutVector, IsSortedAndSumsToOne) {
  ObjectGraph graph;
  graph.Put(0, Vec3(0, 0, 0));
  graph.Put(1, Vec3(0, 3, 0));
  graph.Put(2, Vec3(1, 0, 0));
  graph.Put(3, Vec3(0, 0, -4));
  graph.Put(4, Vec3(50, 0, 0));
  const auto w = LayoutVector(graph, 0, 3);
  ASSERT_TRUE(w);
  EXPECT_LT((*w - Eigen::Vector3d(1. / 8, 3. / 8, 4. / 8)).norm(), 1e-15);
}

TEST(LayoutVector,
     DoesNotChangeWithPoseOrScale) {  // scale being lost is the printed method's trouble
  std::mt19937 random(4);
  const auto uniform = [&] { return (random() % 100000) * 1e-3; };
  ObjectGraph graph, moved;
  const Pose T = Pose::Trans(30, -20, 5) * Pose::RotZ(2.) * Pose::RotX(0.3);
  for (int id = 0; id < 50; ++id) {
    const Vec3 p(uniform(), uniform(), 0.1 * uniform());
    graph.Put(id, p);
    moved.Put(id, 7. * (T * p));
  }
  for (int id = 0; id < 50; ++id)
    EXPECT_LT(LayoutDifference(*LayoutVector(graph, id, 4), *LayoutVector(moved, id, 4)), 1e-12);
}

TEST(LayoutVector, ThereIsNoneWithoutKNeighboursOrOnOneSpot) {
  ObjectGraph graph;
  EXPECT_FALSE(LayoutVector(graph, 0, 2));
  graph.Put(0, Vec3(1, 1, 1));
  graph.Put(1, Vec3(1, 1, 1));
  EXPECT_FALSE(LayoutVector(graph, 0, 2));
  graph.Put(2, Vec3(1, 1, 1));
  EXPECT_FALSE(LayoutVector(graph, 0, 2)) << "all on one spot";
  EXPECT_FALSE(LayoutVector(graph, 0, 0));
  graph.Put(1, Vec3(2, 1, 1));
  ASSERT_TRUE(LayoutVector(graph, 0, 2));
  EXPECT_EQ(*LayoutVector(graph, 0, 2), Eigen::Vector2d(0, 1));
}

TEST(LayoutDifference, IsEquation10) {
  EXPECT_NEAR(LayoutDifference(Eigen::Vector2d(0.2, 0.8), Eigen::Vector2d(0.5, 0.5)),
              0.3 * std::sqrt(2.), 1e-15);
}

}  // namespace
}  // namespace sslcd
