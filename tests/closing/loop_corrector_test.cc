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
  ASSERT_TRUE(ledger.Add(found, {}, query));
  const auto nearest = [&](LandmarkId id, int frame) {
    const FrameStore& frames = world.state.frames;
    return world.passes.NearestSighting(frames, id, frames[frame].travelled).value();
  };
  for (const auto& [early, late] : world.trees)
    ledger.attempts().back().pairs.push_back({nearest(late, query), nearest(early, match)});
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

// A refinement has moved some frames aside, which odometry knows nothing of.
TEST(CorrectTrajectory, KeepsTheStepsOfARefinementUntilOneOfItsLoopsIsRefused) {
  for (const bool wrong : {false, true}) {
    TwoPasses world;
    LoopLedger ledger;
    for (const int i : {-25, 0, 25}) Accept(ledger, world, kFirst + i, kSecond + i);
    if (wrong) Accept(ledger, world, kFirst + 5, kSecond + 12, Pose::Trans(8, 0, 0));
    FrameStore& frames = world.state.frames;
    for (int f = kSecond + 8; f <= kSecond + 18; ++f)
      frames.SetPose(f, frames[f].T_world_cam * Pose::Trans(0.5, 0, 0));
    frames.MarkRefined();
    ledger.MarkRefined();
    ASSERT_TRUE(CorrectTrajectory(world.state, ledger, 1., LoopOptions(), {}, {}));
    EXPECT_EQ(ledger.RefinedByRefused(), wrong);
    const int match = kFirst + 13, query = kSecond + 13;
    const double aside = Apart(frames[match].T_world_cam.inverse() * frames[query].T_world_cam,
                               world.TrueLoop(match, query));
    if (wrong)
      EXPECT_LT(aside, 0.1);
    else
      EXPECT_GT(aside, 0.3);
  }
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

class FuseMatched : public ::testing::Test {
 protected:
  // Returns the number of landmarks that are gone.
  std::size_t Fuse(double fuse_m = 1.) {
    const std::size_t before = world.state.map.landmarks().size();
    FuseMatchedObjects(world.state, world.passes, ledger, fuse_m, {});
    return before - world.state.map.landmarks().size();
  }
  void Refuse(int attempt) { ledger.attempts()[attempt].row().decision = LoopDecision::kAmbiguous; }
  LandmarkId Now(const std::pair<int, int>& sighting) const {
    return world.state.frames[sighting.first].matched[sighting.second];
  }

  TwoPasses world;
  LoopLedger ledger;
};

TEST_F(FuseMatched, WhereTheyHaveComeTogether) {
  world = TwoPasses(Pose::Trans(0, 0, 0.5));
  Accept(ledger, world, kFirst, kSecond);
  EXPECT_EQ(Fuse(0.4), 0u) << "still too far apart";
  EXPECT_EQ(Fuse(), world.trees.size());
  for (const auto& [local, global] : ledger.attempts()[0].pairs) EXPECT_EQ(Now(local), Now(global));
  for (const PassObject& pass : world.passes.passes())
    EXPECT_EQ(pass.id, Now(pass.sightings.front()));
  EXPECT_EQ(Fuse(), 0u) << "nothing is left";
}

TEST_F(FuseMatched, OfAcceptedLoopsOnly) {
  Accept(ledger, world, kFirst, kSecond);
  Refuse(0);
  EXPECT_EQ(Fuse(), 0u);
}

TEST_F(FuseMatched, PairsOfALandmarkThatIsGoneAreLeftOut) {
  Accept(ledger, world, kFirst, kSecond);
  const auto [local, global] = ledger.attempts()[0].pairs[0];
  std::vector<LandmarkId> matched = world.state.frames[local.first].matched;
  matched[local.second] = {10000};
  world.state.frames.SetMatched(local.first, matched);
  matched = world.state.frames[global.first].matched;
  matched[global.second] = {};
  world.state.frames.SetMatched(global.first, matched);
  ledger.attempts()[0].pairs.resize(1);
  EXPECT_EQ(Fuse(), 0u);
}

// Duplicates come to light where something was fused; else nothing has changed for them.
TEST_F(FuseMatched, LooksForDuplicatesOnlyWhereItHasFusedSomething) {
  Accept(ledger, world, kFirst, kSecond);
  ASSERT_GT(Fuse(), 0u);
  MapLandmark twin = world.state.map.at(Now(ledger.attempts()[0].pairs[0].local));
  std::vector<Sighting> of_one, of_twin;  // by turns
  for (const Sighting& sighting : twin.sightings)
    (of_one.size() > of_twin.size() ? of_twin : of_one).push_back(sighting);
  world.state.map.SetSightings(twin.id, of_one);
  twin.sightings = of_twin;
  world.state.map.Insert(twin);
  EXPECT_EQ(Fuse(), 0u);
  EXPECT_EQ(FuseDuplicates(world.state, {}).size(), 1u);
}

TEST_F(FuseMatched, ARefusedLoopTakesBackAllThatItHasFused) {
  const std::size_t count = world.state.map.landmarks().size();
  const auto passes_of = world.passes.passes_of();
  Accept(ledger, world, kFirst, kSecond);
  ledger.attempts()[0].pairs.resize(3);
  EXPECT_EQ(Fuse(), world.trees.size()) << "the others come to light as duplicates";
  Refuse(0);
  Fuse();
  EXPECT_EQ(world.state.map.landmarks().size(), count);
  EXPECT_EQ(world.passes.passes_of(), passes_of);
  ledger.attempts()[0].row().decision = LoopDecision::kAccepted;
  EXPECT_EQ(Fuse(), world.trees.size()) << "and may come back";
}

TEST_F(FuseMatched, WhatAnotherLoopAsksForStays) {
  world = TwoPasses(Pose::Trans(0, 0, 0.5));
  for (const int i : {0, 5}) {
    Accept(ledger, world, kFirst + i, kSecond + i);
    ledger.attempts().back().pairs.resize(i == 0 ? 8 : 4);
  }
  WholeMapOptions no_duplicates;
  no_duplicates.refine.duplicate_m = 0;
  const auto fuse = [&] {
    FuseMatchedObjects(world.state, world.passes, ledger, 1., no_duplicates);
    std::size_t fused = 0;
    for (const auto& [local, global] : ledger.attempts()[0].pairs)
      fused += Now(local) == Now(global);
    return fused;
  };
  EXPECT_EQ(fuse(), 8u);
  Refuse(0);
  EXPECT_EQ(fuse(), 4u);
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
  FuseMatchedObjects(world.state, world.passes, ledger, 100., {});
  ASSERT_EQ(world.state.map.landmarks().size(), world.trees.size());
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
