// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/pose_votes.h"

#include <gmock/gmock.h>

#include <cmath>

namespace sslcd {
namespace {

TEST(PoseVotes, TheBestIsWhereMostAgree) {
  PoseVotes votes;
  EXPECT_TRUE(votes.Best(5).empty());
  for (int i = 0; i < 300; ++i)
    votes.Add({static_cast<std::uint32_t>(i % 20),
               {static_cast<float>(i % 7), 31.f * static_cast<float>(i), -17.f},
               1});
  for (int i = 0; i < 9; ++i) votes.Add({3, {1.5f, 100 + 0.3f * static_cast<float>(i), -40.f}, 2});
  const std::vector<PoseVote> best = votes.Best(5);
  ASSERT_FALSE(best.empty());
  EXPECT_LE(best.size(), 5u);
  EXPECT_EQ(best[0].site, 3u);
  EXPECT_NEAR(best[0].pose.x, 101.2, 1.5);
  EXPECT_NEAR(best[0].pose.y, -40, 1e-3);
  EXPECT_NEAR(best[0].pose.yaw, 1.5, 1e-3);
  votes.Clear();
  EXPECT_TRUE(votes.Best(5).empty());
}

TEST(PoseVotes, ManyVotesAreCountedAndForgotten) {
  PoseVotes votes;
  for (std::uint32_t site = 0; site < 200000; ++site) votes.Add({site, {0, 2, 2}, 1});
  for (int i = 0; i < 9; ++i) votes.Add({3, {1.5f, 101, -41}, 2});
  const std::vector<PoseVote> best = votes.Best(5);
  ASSERT_FALSE(best.empty());
  EXPECT_EQ(best[0].site, 3u);
  EXPECT_NEAR(best[0].weight, 18, 1e-5);
  votes.Clear();
  EXPECT_TRUE(votes.Best(5).empty());
  votes.Add({7, {0, 2, 2}, 0.5f});  // weighs less than what was there
  ASSERT_EQ(votes.Best(5).size(), 1u);
  EXPECT_NEAR(votes.Best(5)[0].weight, 0.5, 1e-6);
}

TEST(PoseVotes, HeadingsWrapAndSitesDiffer) {
  PoseVotes votes;
  for (const float yaw : {-0.02f, 0.02f, static_cast<float>(2 * M_PI) - 0.01f})
    votes.Add({1, {yaw, 2, 2}, 1});
  votes.Add({2, {0, 2, 2}, 1});
  const std::vector<PoseVote> best = votes.Best(9);
  ASSERT_EQ(best.size(), 2u);
  EXPECT_EQ(best[0].site, 1u);
  EXPECT_NEAR(best[0].weight, 3, 1e-6);
  EXPECT_NEAR(std::sin(best[0].pose.yaw), 0, 0.02);
}

}  // namespace
}  // namespace sslcd
