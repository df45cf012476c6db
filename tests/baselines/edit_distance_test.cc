// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/edit_distance.h"

#include <gtest/gtest.h>

#include "baseline_cases.h"

namespace sslcd::baselines {
namespace {

using Spokes = std::vector<Spoke>;

TEST(StarEditDistance, LabelsOnly) {
  const Spokes a{{1, 5}, {1, 6}, {2, 7}}, b{{1, 9}, {3, 7}};
  EXPECT_DOUBLE_EQ(StarEditDistance(a, a, 0), 0);
  EXPECT_DOUBLE_EQ(StarEditDistance(a, b, 0), 3);  // one is kept, two go, one comes
  EXPECT_DOUBLE_EQ(StarEditDistance(b, a, 0), 3);
  EXPECT_DOUBLE_EQ(StarEditDistance(a, {}, 0), 3);
  EXPECT_DOUBLE_EQ(StarEditDistance({}, {}, 0), 0);
}

TEST(StarEditDistance, LengthsCount) {
  EXPECT_DOUBLE_EQ(StarEditDistance({{1, 5}}, {{1, 5.5}}, 2), 0.5);
  EXPECT_DOUBLE_EQ(StarEditDistance({{1, 5}}, {{1, 7}}, 2), 2);
  EXPECT_DOUBLE_EQ(StarEditDistance({{1, 5}}, {{1, 50}}, 2), 2);
  // The best assignment, not the first: 5-5 and 6-6.5 instead of 5-6.5 or 6-5.
  EXPECT_DOUBLE_EQ(StarEditDistance({{1, 6}, {1, 5}}, {{1, 5}, {1, 6.5}}, 2), 0.5);
}

TEST(StarSimilarity, FromNoneToAll) {
  EXPECT_DOUBLE_EQ(StarSimilarity({{1, 5}, {2, 5}}, {{2, 5}, {1, 5}}, 2), 1);
  EXPECT_DOUBLE_EQ(StarSimilarity({{1, 5}}, {{2, 5}}, 2), 0);
  EXPECT_DOUBLE_EQ(StarSimilarity({{1, 5}, {2, 5}}, {{1, 5}}, 2), 2. / 3);
  EXPECT_DOUBLE_EQ(StarSimilarity({}, {}, 2), 0);
}

TEST(SpokesOf, Neighbours) {
  const std::vector<LayoutObject> objects{At(0, 0, 1), At(3, 4, 2), At(50, 0, 3)};
  const LabelGraph graph = MakeLabelGraph(objects, 10);
  const Spokes spokes = SpokesOf(objects, graph, 0);
  ASSERT_EQ(spokes.size(), 1u);
  EXPECT_EQ(spokes[0].label, 2);
  EXPECT_DOUBLE_EQ(spokes[0].length_m, 5);
  EXPECT_TRUE(SpokesOf(objects, graph, 2).empty());
}

TEST(GraphSimilarity, CountsVerticesAndEdges) {
  // size 6
  const LabelGraph triangle = MakeLabelGraph({At(0, 0), At(8, 0), At(4, 5)}, 10);
  // size 5, and one far away
  const LabelGraph chain = MakeLabelGraph({At(0, 0), At(8, 0), At(16, 0), At(900, 0)}, 10);
  EXPECT_DOUBLE_EQ(GraphSimilarity(triangle, triangle, {{0, 0}, {1, 1}, {2, 2}}), 1);
  // a part of the triangle
  EXPECT_DOUBLE_EQ(GraphSimilarity(triangle, chain, {{0, 0}, {1, 1}, {2, 2}}), 1);
  EXPECT_DOUBLE_EQ(GraphSimilarity(chain, triangle, {{0, 0}, {1, 1}, {2, 2}}), 1);
  EXPECT_DOUBLE_EQ(GraphSimilarity(triangle, chain, {{0, 0}, {1, 1}}), 3. / 5);
  EXPECT_DOUBLE_EQ(GraphSimilarity(triangle, chain, {{0, 0}, {1, 2}}), 2. / 5);  // no such edge
  EXPECT_DOUBLE_EQ(GraphSimilarity(triangle, chain, {{0, 3}}), 1);
  EXPECT_DOUBLE_EQ(GraphSimilarity(triangle, chain, {}), 0);
  EXPECT_DOUBLE_EQ(GraphSimilarity({}, {}, {}), 0);
}

}  // namespace
}  // namespace sslcd::baselines
