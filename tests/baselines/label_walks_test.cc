// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/label_walks.h"

#include <gtest/gtest.h>

#include "baseline_cases.h"

namespace sslcd::baselines {
namespace {

using Labels = std::vector<int>;

// 1 - 2 - 3, ten metres apart, and one on its own.
LabelGraph Chain() {
  return MakeLabelGraph({At(0, 0, 1), At(10, 0, 2), At(20, 0, 3), At(90, 0, 4)}, 10);
}

TEST(LabelGraph, EdgesByDistance) {
  const LabelGraph graph = Chain();
  EXPECT_EQ(graph.labels, (Labels{1, 2, 3, 4}));
  EXPECT_EQ(graph.neighbours, (std::vector<Labels>{{1}, {0, 2}, {1}, {}}));
  EXPECT_TRUE(MakeLabelGraph({}, 10).labels.empty());
  EXPECT_EQ(MakeLabelGraph({At(0, 0), At(kNaN, 0), At(1, 0)}, 10).neighbours,
            (std::vector<Labels>{{2}, {}, {0}}));
  EXPECT_EQ(MakeLabelGraph({At(0, 0), At(0, 0)}, 0).neighbours, (std::vector<Labels>{{1}, {0}}));
}

TEST(AllWalks, CountsEveryPath) {
  const std::vector<LabelWalks> walks = AllWalks(Chain(), 2);
  EXPECT_EQ(walks[0], (LabelWalks{{{1, 2, 1}, 1}, {{1, 2, 3}, 1}}));
  EXPECT_EQ(walks[1], (LabelWalks{{{2, 1, 2}, 1}, {{2, 3, 2}, 1}}));
  EXPECT_TRUE(walks[3].empty());
  const std::vector<LabelWalks> equal =
      AllWalks(MakeLabelGraph({At(0, 0), At(1, 0), At(2, 0)}, 10), 2);
  EXPECT_EQ(equal[0], (LabelWalks{{{0, 0, 0}, 4}}));
}

TEST(RandomWalks, SampleTheSamePaths) {
  std::mt19937_64 random(1);
  const LabelGraph graph = Chain();
  const std::vector<LabelWalks> sample = RandomWalks(graph, {10000, 3}, random),
                                all = AllWalks(graph, 3);
  for (int v = 0; v < 3; ++v) {
    int total = 0;
    for (const auto& [labels, count] : sample[v]) {
      EXPECT_EQ(all[v].count(labels), 1u);
      EXPECT_EQ(labels.size(), 4u);
      total += count;
    }
    EXPECT_EQ(total, 10000);
  }
  EXPECT_NEAR(sample[0].at({1, 2, 3, 2}), 5000, 250);  // five standard deviations
  EXPECT_EQ(sample[3], (LabelWalks{{{4, 4, 4, 4}, 10000}}));
}

TEST(RandomWalks, FollowTheSeed) {
  const LabelGraph graph = MakeLabelGraph(Strewn(20, 30, 3, 1), 15);
  std::mt19937_64 one(1), same(1), other(2);
  const std::vector<LabelWalks> walks = RandomWalks(graph, {}, one);
  EXPECT_EQ(walks, RandomWalks(graph, {}, same));
  EXPECT_NE(walks, RandomWalks(graph, {}, other));
}

TEST(Similarity, CommonShareAndCosine) {
  const LabelWalks a{{{1, 2}, 3}, {{1, 3}, 1}}, b{{{1, 2}, 1}, {{1, 4}, 3}},
      doubled{{{1, 2}, 6}, {{1, 3}, 2}};
  EXPECT_DOUBLE_EQ(CommonShare(a, b), 0.25);
  EXPECT_DOUBLE_EQ(CommonShare(a, a), 1);
  EXPECT_DOUBLE_EQ(CommonShare(a, doubled), 0.5);
  EXPECT_DOUBLE_EQ(Cosine(a, b), 3 / 10.);
  EXPECT_DOUBLE_EQ(Cosine(a, doubled), 1);
  EXPECT_EQ(CommonShare({}, {}), 0);
  EXPECT_EQ(CommonShare(a, {}), 0);
  EXPECT_EQ(Cosine({}, a), 0);
}

}  // namespace
}  // namespace sslcd::baselines
