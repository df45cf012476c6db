// SPDX-License-Identifier: BSD-3-Clause
#include "closing/remeasure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refine/fuse.h"
#include "two_passes.h"

namespace sslcd {
namespace {

constexpr int kMatch = 30, kQuery = TwoPasses::kSecond + 30;  // where a loop ties the two passes

// An accepted loop that was measured `error` off the truth.
LoopLedger LedgerOf(const TwoPasses& world, const Pose& error = {}, double sigma_m = 0.1) {
  FoundLoop found;
  found.loop.match = kMatch;
  found.loop.query = kQuery;
  found.loop.row.decision = LoopDecision::kAccepted;
  found.loop.row.T_match_query = world.TrueLoop(kMatch, kQuery) * error;
  // as it is: a metre and a radian per axis
  found.sigma_m = sigma_m;
  SearchWindow window;
  window.end_m = world.state.frames[kQuery].travelled + 25;
  window.local_m = 75;
  LoopLedger ledger;
  ledger.Add(found, window, world.state.frames.back().frame);
  ledger.AcceptNewest();
  return ledger;
}

double Apart(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

TEST(ReviewLoops, WithdrawsWhatTheTrajectoryContradicts) {
  const TwoPasses world;
  const LoopOptions options;
  for (const double off : {0.9, 1.1}) {
    LoopLedger ledger = LedgerOf(world, Pose::Trans(off * options.acceptance.withdraw_m, 0, 0));
    ReviewLoops(world.state, world.passes, ledger, options);
    EXPECT_EQ(ledger.attempts()[0].accepted(), off < 1) << off;
    EXPECT_EQ(ledger.Rows()[0].reason == "the refined trajectory disagrees", off > 1) << off;
  }
}

TEST(ReviewLoops, MeasuresTheOthersAgainByTheObjectsThatBothPassesShare) {
  TwoPasses world;
  MergedIds merged;
  for (const auto& [early, late] : world.trees) {  // a loop closure has fused them
    world.state.map.Fuse(early, late);
    merged[late.value] = early;
  }
  for (int i = 0; i < world.state.frames.size(); ++i) {
    std::vector<LandmarkId> matched = world.state.frames[i].matched;
    for (LandmarkId& id : matched)
      if (merged.count(id.value)) id = merged.at(id.value);
    world.state.frames.SetMatched(i, matched);
  }
  world.passes.Rename(merged);
  LoopLedger ledger = LedgerOf(world, Pose::Trans(0.4, 0, -0.3));
  ReviewLoops(world.state, world.passes, ledger, LoopOptions());
  ASSERT_TRUE(ledger.attempts()[0].remeasured);
  EXPECT_LT(Apart(ledger.Rows()[0].T_match_query, world.TrueLoop(kMatch, kQuery)), 1e-3);
  EXPECT_GT(Apart(ledger.attempts()[0].row().T_match_query, world.TrueLoop(kMatch, kQuery)), 0.4)
      << "what decides about the loop stays as it was measured";
  LoopLedger of_host = LedgerOf(world, Pose::Trans(0.4, 0, -0.3), 0);  // it names no scatter
  ReviewLoops(world.state, world.passes, of_host, LoopOptions());
  EXPECT_FALSE(of_host.attempts()[0].remeasured);
}

TEST(ReviewLoops, WithoutCommonObjectsTheFirstMeasurementStays) {
  const TwoPasses world;  // each tree is another landmark on the second pass
  LoopLedger ledger = LedgerOf(world, Pose::Trans(0.4, 0, 0));
  ReviewLoops(world.state, world.passes, ledger, LoopOptions());
  EXPECT_TRUE(ledger.attempts()[0].accepted());
  EXPECT_FALSE(ledger.attempts()[0].remeasured);
}

class ByViews : public ::testing::Test {
 protected:
  // A tie between the frames `ahead` of match and query, with a standard deviation per axis.
  LoopClosure Measure(int ahead, double sigma_m) {
    LoopLedger ledger = LedgerOf(world_, Pose::Trans(0.4, 0, 0));
    ViewTie tie{kMatch + ahead, kQuery + ahead, {}};
    tie.pose.T_a_b = world_.TrueLoop(tie.from, tie.to);
    tie.pose.covariance *= sigma_m * sigma_m;
    MeasureByViews(world_.state, {tie}, 1., LongPathOdometryNoise(), ledger);
    return ledger.Rows()[0];
  }

  const TwoPasses world_;
};

TEST_F(ByViews, ATieNearbyThatIsMoreCertainMeasuresTheLoop) {
  const LoopClosure row = Measure(3, 0.01);
  EXPECT_TRUE(row.by_views);
  EXPECT_LT(Apart(row.T_match_query, world_.TrueLoop(kMatch, kQuery)), 1e-6);
  EXPECT_GT(row.covariance.trace(), 6 * 1e-4) << "the way to the tie and back counts";
  EXPECT_NEAR(row.viewpoint_change_rad, 0, 1e-6);
}

TEST_F(ByViews, AnUncertainTieDoesNot) {
  EXPECT_TRUE(Measure(0, 0.95).by_views);
  EXPECT_FALSE(Measure(0, 1.05).by_views) << "the objects' is a metre per axis";
}

TEST_F(ByViews, NorATieFarAlongThePath) {
  EXPECT_TRUE(Measure(14, 0.01).by_views) << "14 m on each pass";
  EXPECT_FALSE(Measure(16, 0.01).by_views);
}

TEST(LearnOdometry, WhereItMustNotLearnOrCannotTheWayIsAsConfigured) {
  const TwoPasses world;
  const OdometryFactors in_sight{0.3, 0.8, 0.5, 0.1};
  LoopOptions on, off;
  off.learn_odometry = false;
  const OdometryByLoops not_learnt =
      LearnOdometry(world.state, LedgerOf(world, Pose::Trans(3, 0, 0)), 1, off, 0.1);
  const OdometryByLoops no_loops = LearnOdometry(world.state, LoopLedger(), 1, on, 0.1);
  for (const OdometryByLoops& learnt : {not_learnt, no_loops}) EXPECT_EQ(learnt.turn, 0);
  for (const OdometryFactors& factors : {FactorsOfRefinement(not_learnt, {2, 2, 0.5, 0.1}, off),
                                         FactorsOfRefinement({0.1, 0.1, 0}, in_sight, off),
                                         FactorsOfRefinement(no_loops, in_sight, on)}) {
    EXPECT_EQ(factors.horizontal, 1);
    EXPECT_EQ(factors.heading, 1);
    EXPECT_EQ(factors.vertical, 0.5);
    EXPECT_EQ(factors.tilt, 0.1);
  }
}

TEST(LearnOdometry, OdometryIsNotBetterThanInSight) {
  const TwoPasses world;
  const OdometryByLoops learnt = LearnOdometry(world.state, LedgerOf(world, Pose()), 1, {}, 0);
  EXPECT_LT(learnt.heading, 1);
  EXPECT_LT(learnt.horizontal, 1);
  const OdometryFactors by_loops = FactorsOfRefinement(learnt, {0.01, 0.01}, {});
  EXPECT_EQ(by_loops.heading, learnt.heading);
  EXPECT_EQ(by_loops.horizontal, learnt.horizontal);
  const OdometryFactors in_sight = FactorsOfRefinement(learnt, {4, 3}, {});
  EXPECT_EQ(in_sight.heading, 3);
  EXPECT_EQ(in_sight.horizontal, 2) << "without its caution";
}

}  // namespace
}  // namespace sslcd
