// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_corrector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "two_passes.h"

namespace sslcd {
namespace {

constexpr int kFirst = 30, kSecond = TwoPasses::kSecond + 30;  // frames midway on the two passes

double Apart(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

// Enters an accepted loop between two frames that is `off` the truth.
void Accept(LoopLedger& ledger, const TwoPasses& world, int match, int query,
            const Pose& off = {}) {
  FoundLoop found;
  found.loop.match = match;
  found.loop.query = query;
  found.loop.row.decision = LoopDecision::kAccepted;
  found.loop.row.T_match_query = world.TrueLoop(match, query) * off;
  found.loop.row.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
  for (const auto& [early, late] : world.trees) found.loop.row.pairs.push_back({late, early});
  ASSERT_TRUE(ledger.Add(found, {}, query));
  ledger.AcceptNewest(world.state.frames);
}

const Pose kDrift = Pose::Trans(4, 0, -3) * Pose::RotY(0.1);

TEST(AgreesWithNewLoops, UntilTheTrajectoryHasDrifted) {
  for (const double metres : {0., 3.}) {
    const TwoPasses world(Pose::Trans(metres, 0, 0));
    LoopLedger ledger;
    EXPECT_TRUE(AgreesWithNewLoops(world.state, ledger)) << "there is none";
    Accept(ledger, world, kFirst, kSecond);
    EXPECT_EQ(AgreesWithNewLoops(world.state, ledger), metres == 0);
    ledger.attempts()[0].solved = true;
    EXPECT_TRUE(AgreesWithNewLoops(world.state, ledger)) << "not new any more";
  }
}

TEST(CorrectTrajectory, MovesFramesAndObjectsOfTheSecondPass) {
  TwoPasses world(kDrift);
  LoopLedger ledger;
  for (const int i : {-25, 0, 25}) Accept(ledger, world, kFirst + i, kSecond + i);
  const auto error = [&](int i) {
    const FrameStore& frames = world.state.frames;
    const int match = kFirst + i, query = kSecond + i;
    return Apart(frames[match].T_world_cam.inverse() * frames[query].T_world_cam,
                 world.TrueLoop(match, query));
  };
  const auto apart = [&](std::size_t tree) {
    return (world.state.map.at(world.trees[tree].first).pose.position -
            world.state.map.at(world.trees[tree].second).pose.position)
        .norm();
  };
  EXPECT_GT(error(0), 2);
  EXPECT_GT(apart(3), 1);
  ASSERT_TRUE(CorrectTrajectory(world.state, ledger, 1., LoopOptions(), {}));
  for (const LoopAttempt& attempt : ledger.attempts()) EXPECT_TRUE(attempt.accepted());
  for (const int i : {-25, 0, 25}) EXPECT_LT(error(i), 0.05) << i;
  for (std::size_t tree = 0; tree < world.trees.size(); ++tree) EXPECT_LT(apart(tree), 0.6) << tree;
  EXPECT_TRUE(ledger.attempts()[0].solved);
}

TEST(CorrectTrajectory, TheGraphRefusesALoopThatContradictsTheOthers) {
  for (const bool robust : {true, false}) {
    TwoPasses world;
    LoopLedger ledger;
    for (const int i : {-25, -15, -5, 5, 15, 25}) Accept(ledger, world, kFirst + i, kSecond + i);
    Accept(ledger, world, kFirst, kSecond, Pose::Trans(20, 0, 0));
    LoopOptions options;
    options.robust = robust;
    ASSERT_TRUE(CorrectTrajectory(world.state, ledger, 1., options, {}));
    EXPECT_EQ(ledger.attempts().back().accepted(), !robust);
    for (std::size_t i = 0; i + 1 < ledger.attempts().size(); ++i)
      EXPECT_TRUE(ledger.attempts()[i].accepted());
  }
}

TEST(FuseMatchedObjects, WhereTheyHaveComeTogether) {
  TwoPasses world(Pose::Trans(0, 0, 0.5));
  LoopLedger ledger;
  Accept(ledger, world, kFirst, kSecond);
  EXPECT_TRUE(FuseMatchedObjects(world.state, ledger, 0.4, {}).empty()) << "still too far apart";
  const MergedIds merged = FuseMatchedObjects(world.state, ledger, 1., {});
  EXPECT_EQ(merged.size(), world.trees.size());
  for (const auto& [local, global] : ledger.attempts()[0].pairs) EXPECT_EQ(local, global);
  EXPECT_TRUE(FuseMatchedObjects(world.state, ledger, 1., {}).empty()) << "nothing is left";
}

TEST(FuseMatchedObjects, OfAcceptedLoopsOnly) {
  TwoPasses world;
  LoopLedger ledger;
  Accept(ledger, world, kFirst, kSecond);
  ledger.attempts()[0].row().decision = LoopDecision::kAmbiguous;
  EXPECT_TRUE(FuseMatchedObjects(world.state, ledger, 1., {}).empty());
}

TEST(AdjustAfterLoop, LeavesLongRunsAloneAndKeepsTheScale) {
  TwoPasses world;
  LoopOptions options;
  options.adjust_keyframes = 3;
  const FrameStore::Revision before = world.state.frames.revision();
  EXPECT_FALSE(AdjustAfterLoop(world.state, 1., options, {}).usable);
  EXPECT_EQ(world.state.frames.revision(), before);
  options.adjust_keyframes = 500;
  EXPECT_TRUE(AdjustAfterLoop(world.state, 1., options, {}).usable);
  EXPECT_NE(world.state.frames.revision(), before);
}

TEST(LayoutChange, TakesTheLayoutAroundACameraAlong) {
  const GravityFrame gravity;
  const Pose before = Pose::Trans(10, 0, 40) * Pose::RotY(0.3);
  const Pose motion = Pose::Trans(2, -1, 5) * Pose::RotY(0.4);
  const YawShift change = LayoutChange(before, motion * before, gravity);
  const Eigen::Matrix3d to_layout = gravity.Basis().transpose();
  const Vec3 place(14, 1, 47);
  const Vec3 moved = Apply(change, to_layout * place);
  const Vec3 expected = to_layout * (motion * place);
  EXPECT_NEAR(moved.x(), expected.x(), 1e-9);
  EXPECT_NEAR(moved.y(), expected.y(), 1e-9);
  EXPECT_EQ(change.t.z(), 0) << "heights are the layout's own";
}

}  // namespace
}  // namespace sslcd
