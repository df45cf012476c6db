// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/consensus.h"

#include <gtest/gtest.h>

#include "baseline_cases.h"

namespace sslcd::baselines {
namespace {

using Objects = std::vector<LayoutObject>;

std::optional<Answer> Consensus(const Objects& local, const Objects& global,
                                const ObjectPairs& pairs, int least_inliers = 3) {
  std::mt19937_64 random(1);
  return LargestConsensus(local, global, pairs, {1000, 1, least_inliers}, random);
}

ObjectPairs AllPairs(std::size_t locals, std::size_t globals) {
  ObjectPairs pairs;
  for (std::size_t l = 0; l < locals; ++l)
    for (std::size_t g = 0; g < globals; ++g) pairs.emplace_back(l, g);
  return pairs;
}

TEST(BestPairs, BestOfEachRow) {
  Eigen::MatrixXd similarity(3, 4);
  similarity << 0.5, 0.9, 0.9, 0.2,  //
      0.1, 0.1, 0.1, 0.1,            //
      0, 0, 0.4, 0;
  EXPECT_EQ(BestPairs(similarity, 0.2, 1), (ObjectPairs{{0, 1}, {2, 2}}));
  EXPECT_EQ(BestPairs(similarity, 0.3, 3), (ObjectPairs{{0, 1}, {0, 2}, {0, 0}, {2, 2}}));
  EXPECT_EQ(BestPairs(similarity, 0, 9).size(), 9u);  // never of similarity 0
  EXPECT_TRUE(BestPairs(Eigen::MatrixXd(0, 4), 0, 1).empty());
  EXPECT_TRUE(BestPairs(Eigen::MatrixXd(3, 0), 0, 1).empty());
}

TEST(Consensus, FindsThePoseAmongWrongMatches) {
  const Objects global = Strewn(30, 60, 1, 3);
  const YawShift pose{2, Vec3(5, -8, 0.5)};
  const Objects local = SeenFrom(global, pose, Vec2(30, 30), 18, 0.1);
  ASSERT_GE(local.size(), 5u);
  const auto answer = Consensus(local, global, AllPairs(local.size(), global.size()));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->matches.size(), local.size());
  EXPECT_NEAR(answer->pose.yaw, pose.yaw, 0.02);
  EXPECT_LT((answer->pose.t - pose.t).norm(), 0.4);
  for (std::size_t i = 0; i < answer->matches.size(); ++i) {
    const auto& [l, g] = answer->matches[i];
    EXPECT_EQ(l, static_cast<int>(i));
    EXPECT_LT((Apply(pose, local[l].position) - global[g].position).norm(), 0.2);
  }
}

TEST(Consensus, MatchesAreOneToOne) {
  const Objects local{At(0, 0), At(0.1, 0), At(10, 0), At(0, 10)},
      global{At(0, 0), At(10, 0), At(0, 10)};
  const auto answer = Consensus(local, global, AllPairs(4, 3));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->matches.size(), 3u);
}

TEST(Consensus, DegenerateInput) {
  const Objects one{At(0, 0)}, two{At(0, 0), At(10, 0)}, row{At(0, 0), At(10, 0), At(25, 0)};
  EXPECT_FALSE(Consensus({}, {}, {}));
  EXPECT_FALSE(Consensus(one, one, {{0, 0}}));
  EXPECT_FALSE(Consensus(two, two, {{0, 0}, {1, 1}}));
  EXPECT_TRUE(Consensus(two, two, {{0, 0}, {1, 1}}, 2));
  EXPECT_EQ(Consensus(row, row, AllPairs(3, 3))->matches, (ObjectPairs{{0, 0}, {1, 1}, {2, 2}}));
  const Objects heap{At(1, 1), At(1, 1), At(1, 1), At(1, 1)};  // no heading
  EXPECT_FALSE(Consensus(heap, heap, AllPairs(4, 4)));
  const Objects broken{At(kNaN, 0), At(10, 0), At(25, 0), At(0, kNaN)};
  EXPECT_FALSE(Consensus(broken, broken, AllPairs(4, 4)));
}

TEST(Consensus, MirrorImagesDoNotFit) {
  Objects local{At(0, 0), At(20, 0), At(5, 10), At(12, 17)}, global = local;
  for (LayoutObject& object : global) object.position.y() *= -1;
  EXPECT_FALSE(Consensus(local, global, {{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
}

}  // namespace
}  // namespace sslcd::baselines
