// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_corrector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "loop/layout_likelihood.h"
#include "refine/trajectory_correction.h"
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
  ledger.AcceptNewest();
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

// A new loop agrees within the region where nine of ten true ones are.
TEST(AgreesWithNewLoops, UpToTheChi2OfNineTenths) {
  constexpr double kChi2 = 10.645;  // six degrees of freedom
  const TwoPasses world;
  const double limit_m = 0.01 * std::sqrt(kChi2);  // by Accept's covariance
  for (const double share : {0.99, 1.01}) {
    LoopLedger ledger;
    Accept(ledger, world, kFirst, kSecond, Pose::Trans(0, share * limit_m, 0));
    EXPECT_EQ(AgreesWithNewLoops(world.state, ledger), share < 1);
    Accept(ledger, world, kFirst + 5, kSecond + 5);
    EXPECT_EQ(AgreesWithNewLoops(world.state, ledger), share < 1) << "each of them has to";
  }
}

TEST(AgreesWithNewLoops, AsksNothingOfLoopsThatWereNeverAccepted) {
  const TwoPasses world;
  LoopLedger ledger;
  Accept(ledger, world, kFirst, kSecond, Pose::Trans(3, 0, 0));
  ledger.attempts()[0].in_graph = false;
  EXPECT_TRUE(AgreesWithNewLoops(world.state, ledger));
}

TEST(CorrectTrajectory, NothingMovesWhereTheGraphCannotBeSolved) {
  for (const bool robust : {true, false}) {
    TwoPasses world(kDrift);
    LoopLedger ledger;
    Accept(ledger, world, kFirst, kSecond);
    ledger.attempts()[0].row().covariance(0, 0) = std::nan("");
    LoopOptions options;
    options.robust = robust;
    const FrameStore::Revision before = world.state.frames.revision();
    EXPECT_FALSE(CorrectTrajectory(world.state, ledger, 1., options, {}, {}));
    EXPECT_EQ(world.state.frames.revision(), before);
    EXPECT_TRUE(ledger.attempts()[0].accepted());
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
  ASSERT_TRUE(CorrectTrajectory(world.state, ledger, 1., LoopOptions(), {}, {}));
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
    ASSERT_TRUE(CorrectTrajectory(world.state, ledger, 1., options, {}, {}));
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

TEST(FuseMatchedObjects, PairsOfALandmarkThatIsGoneAreLeftOut) {
  TwoPasses world;
  LoopLedger ledger;
  Accept(ledger, world, kFirst, kSecond);
  auto& pairs = ledger.attempts()[0].pairs;
  const std::size_t count = pairs.size();
  pairs.push_back({LandmarkId{10000}, world.trees[0].first});
  pairs.push_back({world.trees[0].second, LandmarkId{10000}});
  EXPECT_EQ(FuseMatchedObjects(world.state, ledger, 1., {}).size(), count);
}

// Duplicates come to light where something was fused; else nothing has changed for them.
TEST(FuseMatchedObjects, LooksForDuplicatesOnlyWhereItHasFusedSomething) {
  TwoPasses world;
  LoopLedger ledger;
  Accept(ledger, world, kFirst, kSecond);
  ASSERT_FALSE(FuseMatchedObjects(world.state, ledger, 1., {}).empty());
  MapLandmark twin = world.state.map.at(ledger.attempts()[0].pairs[0].first);
  std::vector<Sighting> of_one, of_twin;  // by turns
  for (const Sighting& sighting : twin.sightings)
    (of_one.size() > of_twin.size() ? of_twin : of_one).push_back(sighting);
  world.state.map.SetSightings(twin.id, of_one);
  twin.sightings = of_twin;
  world.state.map.Insert(twin);
  EXPECT_TRUE(FuseMatchedObjects(world.state, ledger, 1., {}).empty());
  EXPECT_EQ(FuseDuplicates(world.state, {}).size(), 1u);
}

TEST(AdjustAfterLoop, LeavesLongRunsAloneAndKeepsTheScale) {
  TwoPasses world;
  LoopOptions options;
  options.adjust_keyframes = 3;
  const FrameStore::Revision before = world.state.frames.revision();
  EXPECT_FALSE(AdjustAfterLoop(world.state, 1., options, {}, {}).usable);
  EXPECT_EQ(world.state.frames.revision(), before);
  options.adjust_keyframes = 500;
  EXPECT_TRUE(AdjustAfterLoop(world.state, 1., options, {}, {}).usable);
  EXPECT_NE(world.state.frames.revision(), before);
}

TEST(AdjustAfterLoop, UpToThatManyKeyframes) {
  LoopOptions options;
  TwoPasses world;
  const auto keyframes = SelectKeyframes(world.state.frames, options.keyframe_m, kGraphKeyframeRad);
  options.adjust_keyframes = static_cast<int>(keyframes.size()) - 1;
  EXPECT_FALSE(AdjustAfterLoop(world.state, 1., options, {}, {}).usable);
  ++options.adjust_keyframes;
  EXPECT_TRUE(AdjustAfterLoop(world.state, 1., options, {}, {}).usable);
}

// Trees that were fused, but a trajectory that was not corrected: far from its minimum.
TEST(AdjustAfterLoop, TakesFourStepsAtMostAndLearnsNoNoise) {
  TwoPasses world(Pose::Trans(20, 0, -10) * Pose::RotY(1));
  LoopLedger ledger;
  Accept(ledger, world, kFirst, kSecond);
  ASSERT_FALSE(FuseMatchedObjects(world.state, ledger, 100., {}).empty());
  const NoiseScale before = world.state.map.noise_scale();
  const auto steps = [&](int max_iterations) {
    TwoPasses copy = world;
    WholeMapOptions whole_map;
    whole_map.ba.max_iterations = max_iterations;
    const int evaluations = AdjustAfterLoop(copy.state, 1., {}, whole_map, {}).iterations;
    EXPECT_EQ(copy.state.map.noise_scale().radial, before.radial);
    return evaluations - 1;
  };
  EXPECT_EQ(steps(50), 4);
  EXPECT_EQ(steps(2), 2) << "fewer where fewer are allowed";
}

// Objects say that odometry is right, but the scale is the refinement's to find.
TEST(AdjustAfterLoop, KeepsTheScaleThatItIsGiven) {
  const auto length_with = [](double scale) {
    TwoPasses world;
    EXPECT_TRUE(AdjustAfterLoop(world.state, scale, {}, {}, {}).usable);
    return world.state.frames[60].T_world_cam.translation().norm();
  };
  EXPECT_NEAR(length_with(1), 60, 1e-3);
  EXPECT_GT(length_with(1.1), 61);
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
