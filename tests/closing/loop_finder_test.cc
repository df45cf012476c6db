// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_finder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "closing/pass_layout.h"
#include "sslcd/core/error.h"
#include "two_passes.h"

namespace sslcd {
namespace {

// Odometry that may be off by what TwoPasses adds on its detour.
const OdometryFactors kPoor{5, 5, 1, 1};

// The local map ends `back_m` before the end of the second pass.
std::optional<FoundLoop> Find(LoopFinder& finder, const TwoPasses& world, double back_m = 0,
                              double lag_m = 25) {
  return finder.Find(
      {world.state, world.passes, {}, kPoor, {world.end_m() - back_m, lag_m, 75, 0}});
}

double Apart(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

TEST(TrackFinder, FindsThePlaceFromBothDirections) {
  for (const bool opposite : {false, true}) {
    const TwoPasses world(Pose::Trans(5, 0, -3) * Pose::RotY(0.1), opposite);
    const auto finder = MakeTrackFinder(LoopOptions());
    const auto found = Find(*finder, world);
    ASSERT_TRUE(found);
    const LoopMeasurement& loop = found->loop;
    EXPECT_EQ(loop.row.decision, LoopDecision::kAccepted) << loop.row.reason;
    EXPECT_TRUE(found->confirmed);
    EXPECT_GE(found->track, 0);
    EXPECT_LT(Apart(loop.row.T_match_query, world.TrueLoop(loop.match, loop.query)), 0.05);
    for (const auto& [local, global] : loop.row.pairs)
      EXPECT_EQ(local.value, global.value + 1) << "a tree with itself";
  }
}

TEST(TrackFinder, TheQueryCameraStandsBackByTheLag) {
  const TwoPasses world(Pose::Trans(5, 0, -3));
  for (const double lag_m : {15., 25., 35.}) {
    const auto found = Find(*MakeTrackFinder(LoopOptions()), world, 0, lag_m);
    ASSERT_TRUE(found);
    EXPECT_NEAR(world.state.frames[found->loop.query].travelled, world.end_m() - lag_m, 1);
  }
}

TEST(TrackFinder, LaterCamerasHaveLoopsByTheSamePlace) {
  const TwoPasses world(Pose::Trans(5, 0, -3));
  const double end_m = world.end_m();
  const std::vector<double> wanted{end_m - 20, end_m - 5};
  LoopOptions options;
  const auto find = [&] {
    return MakeTrackFinder(options)->Find(
        {world.state, world.passes, {}, kPoor, {end_m, 25, 75, 0}, wanted});
  };
  const auto found = find();
  ASSERT_TRUE(found);
  ASSERT_EQ(found->early.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const LoopMeasurement& loop = found->early[i].loop;
    EXPECT_EQ(loop.row.decision, LoopDecision::kAccepted);
    EXPECT_NEAR(world.state.frames[loop.query].travelled, wanted[i], 1);
    EXPECT_LT(Apart(loop.row.T_match_query, world.TrueLoop(loop.match, loop.query)), 0.05);
  }
  options.acceptance.max_risk = 0;
  const auto refused = find();
  ASSERT_TRUE(refused);
  ASSERT_NE(refused->loop.row.decision, LoopDecision::kAccepted);
  EXPECT_TRUE(refused->early.empty());
}

TEST(TrackFinder, WithoutARivalTheSecondScoreIsTheOddsAgainstTheOnlyTrack) {
  const TwoPasses world(Pose::Trans(5, 0, -3));
  LoopOptions options;
  options.tracks.max_tracks = 1;
  const auto only = Find(*MakeTrackFinder(options), world);
  ASSERT_TRUE(only);
  EXPECT_GT(only->loop.row.score, 5);
  EXPECT_EQ(only->loop.row.second_score, -only->loop.row.score);
}

TEST(TrackFinder, TheProbabilityIsThatOfTheLogOdds) {
  const TwoPasses world(Pose::Trans(5, 0, -3));
  LoopOptions options;
  options.tracks.look_alike = 0.25;  // in doubt
  const auto found = Find(*MakeTrackFinder(options), world);
  ASSERT_TRUE(found && found->loop.row.probability);
  const double p = *found->loop.row.probability;
  EXPECT_GT(p, 0.5);
  EXPECT_LT(p, 0.9);
  EXPECT_NEAR(std::log(p / (1 - p)), found->loop.row.score, 1e-9);
}

// Evidence is against poses anywhere in the map; with its track an attempt needs much less.
TEST(TrackFinder, FewObjectsOfItsOwnAreEnoughWhereTheTrackExpectsThem) {
  const TwoPasses world(Pose(), false, 7);
  const auto found = Find(*MakeTrackFinder(LoopOptions()), world);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->confirmed) << found->loop.row.reason;
}

TEST(TrackFinder, AHigherBarLeavesItAmbiguous) {
  const TwoPasses world(Pose::Trans(5, 0, -3));
  LoopOptions options;
  options.acceptance.max_risk = 0;
  const auto found = Find(*MakeTrackFinder(options), world);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->loop.row.decision, LoopDecision::kAmbiguous);
  EXPECT_TRUE(found->confirmed) << "its own objects say enough";
  EXPECT_EQ(found->loop.row.reason, "another pose fits nearly as well");
}

TEST(TrackFinder, ATrackGoesOnFromAttemptToAttempt) {
  const TwoPasses world(Pose::Trans(5, 0, -3));
  const auto finder = MakeTrackFinder(LoopOptions());
  const auto first = Find(*finder, world, 20);
  const auto second = Find(*finder, world, 10);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->track, second->track);
  finder->Reset();
  const auto third = Find(*finder, world, 5);
  ASSERT_TRUE(third);
  EXPECT_NE(third->track, second->track);
}

// Two objects beside the end of the way are fewer than have to agree.
TEST(TrackFinder, ATrackSurvivesAStretchWithFewObjects) {
  std::vector<Vec3> places = TwoPasses::Strewn(24);
  for (Vec3& place : places) place.z() *= 0.7;
  places.insert(places.end(), {Vec3(3, 1, 57), Vec3(-5, 1, 58)});
  const TwoPasses world(Pose::Trans(5, 0, -3), false, places);
  const auto finder = MakeTrackFinder(LoopOptions());
  const auto find = [&](double back_m, double local_m) {
    return finder->Find(
        {world.state, world.passes, {}, kPoor, {world.end_m() - back_m, 25, local_m, 0}});
  };
  const auto before = find(10, 75);
  ASSERT_TRUE(before);
  ASSERT_EQ(PassLayouts(world.passes, world.state)
                .Between(world.end_m() - 10, world.end_m(), 2)
                .objects.size(),
            2u);
  EXPECT_FALSE(find(0, 10));
  const auto after = find(0, 75);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->track, before->track);
}

// Objects that are too close to each other propose no pose; the trajectory's is looked at anyway.
TEST(TrackFinder, ThePlaceMayBeWhereTheTrajectoryHasIt) {
  const std::vector<Vec3> heap{
      {-5, 1, 30}, {-3.8, 1, 30.7}, {-4.6, 1, 31.5}, {-3.5, 1, 32.1}, {-5.2, 1, 32.4}};
  LoopOptions options;
  options.match.search.min_matches = 5;  // all of them
  const auto here = Find(*MakeTrackFinder(options), TwoPasses(Pose(), false, heap));
  ASSERT_TRUE(here);
  EXPECT_EQ(here->loop.row.pairs.size(), heap.size());
  EXPECT_FALSE(Find(*MakeTrackFinder(options), TwoPasses(Pose::Trans(20, 0, 0), false, heap)));
  options.match.search.min_matches = 6;
  EXPECT_FALSE(Find(*MakeTrackFinder(options), TwoPasses(Pose(), false, heap)));
}

// An even row of trees, which odometry puts one tree too far, and some that tell.
TEST(TrackFinder, TheSecondScoreIsOfTheSecondBestPlace) {
  std::vector<Vec3> places{{5, 1, 12}, {6, 1, 31}, {4, 1, 43}};
  for (int i = 0; i < 6; ++i) places.push_back({-4, 1, 15. + 5 * i});
  const TwoPasses world(Pose::Trans(0, 0, 5), false, places);
  LoopOptions options;
  options.tracks.max_tracks = 2;
  options.tracks.look_alike = 1e-12;
  const auto found = Find(*MakeTrackFinder(options), world);
  ASSERT_TRUE(found);
  const LoopClosure& row = found->loop.row;
  EXPECT_GT(row.score, 0);
  EXPECT_LT(row.second_score, 0);
  EXPECT_LT(row.score + row.second_score, -1e-9) << "'nowhere' is a rival of both";
  EXPECT_GT(row.score + row.second_score, -2 * std::log(2)) << "and less likely than both";
}

// The second pass is a sequence of its own, so no odometry tells where it is.
std::optional<FoundLoop> FindWithLooks(const TwoPasses& world, bool same) {
  MapState state{world.state.map, FrameStore(300)};
  PassMap passes{{}, 30.};
  for (int i = 0; i < world.state.frames.size(); ++i) {
    const bool second = i >= TwoPasses::kSecond;
    const FrameRecord& record = world.state.frames[i];
    std::vector<Detection> seen = record.detections;
    for (std::size_t k = 0; k < seen.size(); ++k) {  // ids of a tree are even and odd
      const int tree = record.matched[k].value / 2;
      const float angle = static_cast<float>(tree) + (second && !same ? 1.6f : 0.f);
      seen[k].appearance[Cue::kEmbedding] = {std::cos(angle), std::sin(angle)};
    }
    state.frames.Append(record, StepUncertainty{i == TwoPasses::kSecond});
    passes.AddFrame(state, seen);
  }
  return MakeTrackFinder(LoopOptions())
      ->Find({state, passes, {}, kPoor, {state.frames.back().travelled, 25, 75, 0}});
}

TEST(TrackFinder, LooksDecideWhereNoOdometryDoes) {
  const TwoPasses world(Pose::Trans(5, 0, -3));
  const auto same = FindWithLooks(world, true), other = FindWithLooks(world, false);
  ASSERT_TRUE(same && other);
  EXPECT_EQ(same->loop.row.decision, LoopDecision::kAccepted) << same->loop.row.reason;
  EXPECT_NE(other->loop.row.decision, LoopDecision::kAccepted);
  EXPECT_EQ(other->loop.row.reason, "the objects look different");
}

TEST(TrackFinder, ACloneGoesItsOwnWay) {
  const TwoPasses world(Pose::Trans(5, 0, -3));
  const auto finder = MakeTrackFinder(LoopOptions());
  ASSERT_TRUE(Find(*finder, world, 20));
  const auto clone = finder->Clone();
  const auto a = Find(*finder, world), b = Find(*clone, world);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->loop.row.score, b->loop.row.score);
  EXPECT_EQ(a->track, b->track);
}

TEST(TrackFinder, NoneBeforeThereIsAnOldMapOrWithTooFewObjects) {
  const TwoPasses world;
  const auto finder = MakeTrackFinder(LoopOptions());
  EXPECT_FALSE(Find(*finder, world, world.end_m() - 60)) << "the first pass";
  const TwoPasses sparse(Pose(), false, 3);
  EXPECT_FALSE(Find(*MakeTrackFinder(LoopOptions()), sparse));
}

TEST(PrintedFinder, TiesTheNewestCameraToTheFirstThatSawAMatchedObject) {
  const TwoPasses world;
  LoopOptions options;
  const auto found = Find(*MakePrintedFinder(options), world);
  ASSERT_TRUE(found);
  const LoopMeasurement& loop = found->loop;
  EXPECT_EQ(loop.row.decision, LoopDecision::kAccepted) << "it knows no refusal";
  EXPECT_EQ(loop.query, world.state.frames.size() - 1);
  int first = loop.query;
  for (const auto& pair : loop.row.pairs)
    for (const PassObject& pass : world.passes.passes())
      if (pass.id == pair.second) first = std::min(first, pass.sightings.front().first);
  EXPECT_EQ(loop.match, first);
  EXPECT_EQ(found->track, -1);
  EXPECT_FALSE(loop.row.probability) << "a sum of similarities is no log odds";
}

TEST(PrintedFinder, NoneWhereTooFewObjectsMatch) {
  const TwoPasses world;
  LoopOptions options;
  options.paper.min_matches = 1000;
  EXPECT_FALSE(Find(*MakePrintedFinder(options), world));
}

// A host that knows which trees are the same.
PlaceMatcher Knowing(const TwoPasses& world, bool sure) {
  return [&world, sure](const PlaceQuery& query) {
    PlaceAnswer answer;
    for (std::size_t i = 0; i < query.local.size(); ++i)
      for (std::size_t j = 0; j < query.global.size(); ++j)
        for (const auto& [early, late] : world.trees)
          if (query.local[i].id == late.value && query.global[j].id == early.value)
            answer.matches.push_back({static_cast<int>(i), static_cast<int>(j)});
    answer.score = 4;
    answer.accepted = sure;
    return std::optional<PlaceAnswer>(answer);
  };
}

TEST(HostFinder, MeasuresWhatTheHostMatchesAndLeavesTheDecisionToIt) {
  const TwoPasses world(Pose::Trans(5, 0, -3) * Pose::RotY(0.1));
  for (const bool sure : {true, false}) {
    const auto finder = MakeHostFinder(LoopOptions(), Knowing(world, sure));
    const auto found = Find(*finder, world);
    ASSERT_TRUE(found);
    const LoopMeasurement& loop = found->loop;
    EXPECT_EQ(loop.row.decision, sure ? LoopDecision::kAccepted : LoopDecision::kAmbiguous);
    EXPECT_EQ(loop.row.score, 4);
    EXPECT_FALSE(loop.row.probability) << "a host's score may mean anything";
    EXPECT_LT(Apart(loop.row.T_match_query, world.TrueLoop(loop.match, loop.query)), 0.05);
    EXPECT_FALSE(finder->SupportsSecondSearch()) << "a host is asked in order of time";
  }
}

TEST(HostFinder, ImagesTieTheNewestCamera) {
  const TwoPasses world;
  const Pose T_match_query = Pose::Trans(0.5, 0, 1);
  const auto images = [&](const PlaceQuery& query) {
    PlaceAnswer answer;
    answer.match_frame = query.old_frame;
    answer.T_match_query = T_match_query;
    answer.accepted = true;
    return std::optional<PlaceAnswer>(answer);
  };
  LoopOptions options;
  const auto found = Find(*MakeHostFinder(options, images), world);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->loop.query, world.state.frames.size() - 1);
  EXPECT_EQ(Apart(found->loop.row.T_match_query, T_match_query), 0);
  EXPECT_EQ(found->sigma_m, 0) << "no objects to measure by again";
  EXPECT_NEAR(found->loop.row.covariance(0, 0), options.sigma_m * options.sigma_m, 1e-12);
  EXPECT_FALSE(Find(*MakeHostFinder(options, images), world, 0, options.lag_m - 5))
      << "was asked before";
}

TEST(HostFinder, RefusesAnswersThatNameNothing) {
  const TwoPasses world;
  const auto answering = [&](const PlaceAnswer& answer) {
    const auto finder = MakeHostFinder(
        LoopOptions(), [answer](const PlaceQuery&) { return std::optional<PlaceAnswer>(answer); });
    return Find(*finder, world);
  };
  PlaceAnswer answer;
  answer.matches = {{1000, 0}};
  EXPECT_THROW(answering(answer), Error);
  answer.matches = {{0, -1}};
  EXPECT_THROW(answering(answer), Error);
  answer.matches.clear();
  answer.match_frame = world.state.frames.back().frame;  // not an old one
  EXPECT_THROW(answering(answer), Error);
}

}  // namespace
}  // namespace sslcd
