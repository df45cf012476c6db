// SPDX-License-Identifier: BSD-3-Clause
#include "refine/fuse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "refine/path_segments.h"
#include "two_visits.h"

namespace sslcd {
namespace {

TEST(FuseMatched, MatchedPairsBecomeOneAndFramesFollow) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}, 0, 8), late = world.Add({4, 1, 13}, 300, 4);
  const MergedIds merged = FuseMatched(world.state, {{late, early}}, world.options);
  EXPECT_EQ(merged.size(), 1u);
  EXPECT_EQ(Resolve(late, merged).value, early.value);
  ASSERT_TRUE(world.Gone(late));
  EXPECT_EQ(world.map.at(early).sightings.size(), 12u);
  const double z = world.map.at(early).pose.position.z();
  EXPECT_GT(z, 12.1) << "the mean of both ...";
  EXPECT_LT(z, 12.5) << "... and nearer to the one seen more often";
  for (const FrameRecord& record : world.frames)
    for (const LandmarkId id : record.matched) EXPECT_EQ(id.value, early.value);
}

TEST(FuseMatched, ChainsRepeatsAndNonsense) {
  TwoVisits world;
  const LandmarkId a = world.Add({4, 1, 12}, 0, 3), b = world.Add({4, 1, 14}, 300, 5),
                   c = world.Add({4, 1, 16}, 306, 2);
  const LandmarkId car = world.Add({-4, 1, 12}, 0, 5, "Car");
  const MergedIds merged =
      FuseMatched(world.state, {{a, b}, {b, c}, {c, a}, {a, a}, {a, {77}}, {{-1}, {}}, {a, car}},
                  world.options);
  EXPECT_EQ(merged.size(), 2u);
  EXPECT_EQ(Resolve(a, merged).value, b.value);
  EXPECT_EQ(Resolve(c, merged).value, b.value);
  EXPECT_EQ(Resolve(car, merged).value, car.value);
  EXPECT_EQ(world.map.landmarks().size(), 2u);
  EXPECT_TRUE(FuseMatched(world.state, {}, world.options).empty());
}

TEST(FuseMatched, SeenTogetherOrDrivingIsRefused) {
  TwoVisits world;
  const LandmarkId a = world.Add({4, 1, 12}, 0, 6), b = world.Add({4, 1, 15}, 3, 6);
  const LandmarkId car = world.Add({-4, 1, 12}, 0, 5, "Car"),
                   twin = world.Add({-4, 1, 14}, 300, 5, "Car");
  world.map.SetState(twin, LandmarkState::kDynamic);
  EXPECT_TRUE(FuseMatched(world.state, {{a, b}, {car, twin}}, world.options).empty());
}

TEST(FuseMatched, HeadingsMeetHalfATurnApart) {
  TwoVisits world;
  const LandmarkId a = world.Add({-4, 1, 12}, 0, 5, "Car", 0.1);
  const LandmarkId b = world.Add({-4, 1, 12}, 300, 5, "Car", 0.3 + M_PI);
  FuseMatched(world.state, {{a, b}}, world.options);
  EXPECT_NEAR(world.map.at(a).pose.yaw, 0.2, 1e-6);
}

TEST(FuseMatched, APairTiesItsSurroundings) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12}, 0, 8), again = world.Add({4.1, 1, 12}, 300, 4);
  const LandmarkId next = world.Add({-4, 1, 15}, 0, 8),
                   next_again = world.Add({-4, 1, 15.1}, 300, 4);
  EXPECT_TRUE(FuseDuplicates(world.state, world.options).empty())
      << "drift may have put them there";
  EXPECT_EQ(FuseMatched(world.state, {{tree, again}}, world.options).size(), 2u);
  EXPECT_TRUE(world.Gone(next_again));
  EXPECT_FALSE(world.Gone(next));
}

TEST(FuseDuplicates, NeighboursAreNotTwins) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12}, 0, 4), twin = world.Add({4.2, 1, 12}, 4, 3);
  const LandmarkId neighbour = world.Add({4, 1, 13.5}, 4, 3), stick = world.Add({4, 1, 12.3}, 0, 3);
  const LandmarkId other_kind = world.Add({4, 1, 12}, 4, 3, "Car");
  FuseDuplicates(world.state, world.options);
  EXPECT_TRUE(world.Gone(twin));
  EXPECT_FALSE(world.Gone(tree));
  EXPECT_FALSE(world.Gone(neighbour)) << "1.5 m off: another tree";
  EXPECT_FALSE(world.Gone(stick)) << "seen together with the tree";
  EXPECT_FALSE(world.Gone(other_kind));
}

TEST(FuseDuplicates, NothingAndNonFiniteDoNoHarm) {
  TwoVisits world;
  EXPECT_TRUE(FuseDuplicates(world.state, world.options).empty());
  MapState no_frames{world.map, {}};
  EXPECT_TRUE(FuseDuplicates(no_frames, world.options).empty());
  const LandmarkId a = world.Add({4, 1, 12}, 0, 4), b = world.Add({4, 1, 12}, 4, 3);
  world.map.SetPose(b, {Vec3(4, 1, std::numeric_limits<double>::quiet_NaN()), 0});
  FuseDuplicates(world.state, world.options);
  EXPECT_FALSE(world.Gone(a));
  EXPECT_TRUE(world.map.at(a).pose.position.allFinite());
}

MapLandmark SeenIn(int first, int count) {
  MapLandmark landmark;
  for (int frame = first; frame < first + count; ++frame) {
    landmark.sightings.emplace_back();
    landmark.sightings.back().frame = frame;
  }
  return landmark;
}

TEST(SeenTogether, InMoreThanATenthOfTheSightingsOfTheOneSeenLess) {
  const MapLandmark often = SeenIn(0, 100), seldom = SeenIn(95, 20), slip = SeenIn(98, 20);
  EXPECT_TRUE(SeenTogether(often, seldom)) << "5 of 20";
  EXPECT_TRUE(SeenTogether(seldom, often));
  EXPECT_FALSE(SeenTogether(often, slip)) << "2 of 20";
  EXPECT_FALSE(SeenTogether(slip, often));
  EXPECT_TRUE(SeenTogether(often, SeenIn(97, 20))) << "3 of 20";
  EXPECT_FALSE(SeenTogether(often, SeenIn(200, 5)));
  EXPECT_FALSE(SeenTogether(often, MapLandmark()));
}

TEST(FuseMatched, TheConfirmedOneKeepsItsNameElseTheOneSeenMoreOften) {
  for (const bool swapped : {false, true}) {
    TwoVisits world;
    const LandmarkId once = world.Add({4, 1, 12}, 0, 2), again = world.Add({4, 1, 12}, 300, 8);
    const auto pair = swapped ? std::make_pair(again, once) : std::make_pair(once, again);
    world.map.SetState(again, LandmarkState::kTentative);
    FuseMatched(world.state, {pair}, world.options);
    EXPECT_TRUE(world.Gone(again)) << "confirmed counts before often";
    EXPECT_FALSE(world.Gone(once));
    EXPECT_EQ(world.map.at(once).sightings.size(), 10u);
  }
  TwoVisits world;
  const LandmarkId once = world.Add({4, 1, 12}, 0, 2), again = world.Add({4, 1, 12}, 300, 8);
  FuseMatched(world.state, {{once, again}}, world.options);
  EXPECT_TRUE(world.Gone(once));
}

// A detector that is as exact in all directions and at all ranges.
DetectionNoise EvenNoise(double sigma_m, double sigma_rad) {
  DetectionNoise noise;
  noise.radial_m = noise.lateral_m = noise.vertical_m = sigma_m;
  noise.radial_per_m = noise.lateral_per_m = noise.vertical_per_m = noise.yaw_per_m = 0;
  noise.yaw_rad = sigma_rad;
  return noise;
}

// Sightings that are all as exact: means weighted by how often each was seen.
TEST(FuseMatched, PoseIsTheMeanWeightedByInformation) {
  for (const double sigma_rad : {0.02, 10.}) {
    TwoVisits world;
    world.options.noise = EvenNoise(1, sigma_rad);
    const LandmarkId a = world.Add({-4, 1, 12}, 0, 8, "Car", 0.1),
                     b = world.Add({-4, 1.5, 13}, 300, 2, "Car", 0.3);
    FuseMatched(world.state, {{b, a}}, world.options);
    const UprightPose& pose = world.map.at(a).pose;
    EXPECT_NEAR(pose.yaw, (8 * 0.1 + 2 * 0.3) / 10, 1e-9);
    EXPECT_LT((pose.position - Vec3(-4, 1 + 0.5 * 2 / 10, 12 + 1. * 2 / 10)).norm(), 1e-9);
  }
}

TEST(FuseMatched, TheOneSeenLessMayKeepItsNameButNotItsPose) {
  TwoVisits world;
  world.options.noise = EvenNoise(1, 0.02);
  const LandmarkId once = world.Add({-4, 1, 12}, 0, 2, "Car", 0.1),
                   again = world.Add({-4, 1, 13}, 300, 8, "Car", 0.3);
  world.map.SetState(again, LandmarkState::kTentative);
  FuseMatched(world.state, {{once, again}}, world.options);
  EXPECT_NEAR(world.map.at(once).pose.yaw, (2 * 0.1 + 8 * 0.3) / 10, 1e-9);
  EXPECT_NEAR(world.map.at(once).pose.position.z(), 12.8, 1e-9);
}

TEST(FuseMatched, WithoutAnyKnownFrameThePoseStays) {
  TwoVisits world;
  const LandmarkId a = world.Add({-4, 1, 12}, 0, 8, "Car", 0.1),
                   b = world.Add({-4, 1, 13}, 300, 2, "Car", 0.3);
  MapState no_frames{world.map, {}};
  EXPECT_EQ(FuseMatched(no_frames, {{a, b}}, world.options).size(), 1u);
  EXPECT_EQ(no_frames.map.at(a).pose.position, Vec3(-4, 1, 12));
  EXPECT_EQ(no_frames.map.at(a).pose.yaw, 0.1);
}

TEST(FuseMatched, WhatIsRoundSaysNothingOfTheYaw) {
  TwoVisits world;
  const LandmarkId a = world.Add({4, 1, 12}, 0, 8, "Tree", 0.1),
                   b = world.Add({4, 1, 12}, 300, 2, "Tree", 0.3);
  FuseMatched(world.state, {{a, b}}, world.options);
  EXPECT_EQ(world.map.at(a).pose.yaw, 0.1);
}

// With a detector that is next to exact, bodies alone decide: two objects overlap by more than half
// where their centres are within half of their mean width.
TEST(FuseDuplicates, NearerThanHalfTheirWidthIsOnePlace) {
  for (const auto& [label, width] : {std::pair<const char*, double>{"Tree", 0.5}, {"Car", 1.8}}) {
    for (const double share : {0.49, 0.51}) {
      TwoVisits world;
      world.options.noise = EvenNoise(1e-4, 0.02);
      world.Add({4, 1, 12}, 0, 4, label);
      const LandmarkId twin = world.Add({4 + share * width, 1, 12}, 4, 3, label);
      FuseDuplicates(world.state, world.options);
      EXPECT_EQ(world.Gone(twin), share < 0.5) << label;
    }
  }
}

// A car park: y is down.
TEST(FuseDuplicates, CarsAboveEachOtherAreTwo) {
  TwoVisits world;
  const LandmarkId lower = world.Add({4, 1, 12}, 0, 4, "Car"),
                   upper = world.Add({4, -2, 12}, 4, 3, "Car"),
                   shifted = world.Add({4.3, 1, 12.3}, 4, 3, "Car");
  FuseDuplicates(world.state, world.options);
  EXPECT_FALSE(world.Gone(lower));
  EXPECT_FALSE(world.Gone(upper)) << "on the storey above";
  EXPECT_TRUE(world.Gone(shifted)) << "it overlaps the lower one";
  EXPECT_EQ(world.map.at(upper).pose.position.y(), -2);
}

// With a detector that is next to exact, as above, but one above the other: half of 1.5 m.
TEST(FuseDuplicates, NearerThanHalfTheirHeightIsOnePlace) {
  for (const double share : {0.49, 0.51}) {
    TwoVisits world;
    world.options.noise = EvenNoise(1e-4, 0.02);
    world.Add({4, 1, 12}, 0, 4, "Car");
    const LandmarkId twin = world.Add({4, 1 - share * 1.5, 12}, 4, 3, "Car");
    FuseDuplicates(world.state, world.options);
    EXPECT_EQ(world.Gone(twin), share < 0.5);
  }
}

// Two trees, each seen once, by a detector that is as exact in all directions. Their distance is
// explained where its square is within the 99 % quantile (three components) of both variances.
TEST(FuseDuplicates, WhatTheDetectorsErrorsExplainIsOnePlace) {
  constexpr double kSigma = 0.05, kQuantile = 11.34;
  for (const double learnt : {1., 2.}) {
    for (const double share : {0.98, 1.02}) {
      TwoVisits world;
      world.options.noise = EvenNoise(kSigma, 0.02);
      world.options.refine.duplicate_m = 2;
      world.map.SetNoiseScale(NoiseScale::Uniform(learnt));
      const double scale = std::hypot(kNoiseCaution * learnt, kLongTailScale);
      const double apart = share * std::sqrt(kQuantile * 2) * scale * kSigma;
      ASSERT_GT(apart, 0.26) << "beyond their bodies";
      world.Add({4, 1, 12}, 0, 1);
      const LandmarkId twin = world.Add({4, 1, 12 + apart}, 4, 1);
      FuseDuplicates(world.state, world.options);
      EXPECT_EQ(world.Gone(twin), share < 1) << apart;
    }
  }
}

TEST(FuseDuplicates, TheDetectorsErrorsExplainHeightsToo) {
  for (const double vertical_m : {0.05, 0.8}) {
    TwoVisits world;
    world.options.noise = EvenNoise(0.05, 0.02);
    world.options.noise.vertical_m = vertical_m;
    world.Add({4, 1, 12}, 0, 1, "Car");
    const LandmarkId twin = world.Add({4, -1, 12}, 4, 1, "Car");
    FuseDuplicates(world.state, world.options);
    EXPECT_EQ(world.Gone(twin), vertical_m > 0.5);
  }
}

// Errors of one object correlate from sighting to sighting.
TEST(FuseDuplicates, ToBeSeenOftenMakesNoTwins) {
  TwoVisits world;
  world.options.noise = EvenNoise(0.1, 0.02);
  world.Add({4, 1, 12}, 0, 5);
  const LandmarkId twin = world.Add({4, 1, 12.9}, 5, 5);
  FuseDuplicates(world.state, world.options);
  EXPECT_TRUE(world.Gone(twin));
}

// A twin in the middle draws the one in front of it away from the one behind.
TEST(FuseDuplicates, TheDistanceIsThatOfTheMeanSoFar) {
  for (const double duplicate_m : {0.9, 1.3}) {
    TwoVisits world;
    world.options.noise = EvenNoise(1, 0.02);
    world.options.refine.duplicate_m = duplicate_m;
    world.Add({4, 1, 12}, 0, 4);
    const LandmarkId middle = world.Add({4, 1, 12.8}, 4, 3), behind = world.Add({4, 1, 11.2}, 7, 2);
    FuseDuplicates(world.state, world.options);
    EXPECT_TRUE(world.Gone(middle));
    EXPECT_EQ(world.Gone(behind), duplicate_m > 0.8 + 0.8 * 3 / 7);
  }
}

TEST(FuseDuplicates, OfTwoSeenAsOftenTheFormerKeepsItsName) {
  TwoVisits world;
  const LandmarkId former = world.Add({4, 1, 12}, 0, 4), twin = world.Add({4.1, 1, 12}, 4, 4);
  FuseDuplicates(world.state, world.options);
  EXPECT_FALSE(world.Gone(former));
  EXPECT_TRUE(world.Gone(twin));
}

TEST(FuseDuplicates, FurtherThanDuplicateIsNotOnePlace) {
  for (const double duplicate_m : {0.15, 0.25}) {
    TwoVisits world;
    world.options.refine.duplicate_m = duplicate_m;
    world.Add({4, 1, 12}, 0, 4);
    const LandmarkId twin = world.Add({4.2, 1, 12}, 4, 3);
    FuseDuplicates(world.state, world.options);
    EXPECT_EQ(world.Gone(twin), duplicate_m > 0.2);
  }
}

TEST(FuseDuplicates, TentativeOnesAndThoseThatDriveAreLeftAlone) {
  for (const LandmarkState state : {LandmarkState::kTentative, LandmarkState::kDynamic}) {
    TwoVisits world;
    world.Add({4, 1, 12}, 0, 4);
    const LandmarkId twin = world.Add({4, 1, 12}, 4, 3);
    world.map.SetState(twin, state);
    FuseDuplicates(world.state, world.options);
    EXPECT_FALSE(world.Gone(twin));
  }
}

TEST(PathSegments, NeighboursAndSharedObjectsTie) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}, 0, 3), late = world.Add({4, 1, 12}, 300, 3);
  const LandmarkId soon = world.Add({4, 1, 16}, 5, 3);
  PathSegments apart(world.state, 60.);
  EXPECT_TRUE(apart.Covisible(early, soon));
  EXPECT_FALSE(apart.Covisible(early, late));
  EXPECT_FALSE(apart.Covisible(world.frames.back(), early));
  EXPECT_TRUE(PathSegments(world.state, 0.).Covisible(early, late));
  apart.Fuse(early, late);
  EXPECT_TRUE(apart.Covisible(early, late));
  EXPECT_TRUE(apart.Covisible(world.frames.back(), early));
  EXPECT_FALSE(apart.Covisible(soon, late)) << "the one that is left has them";
  world.map.Fuse(early, late);
  const PathSegments tied(world.state, 60.);
  EXPECT_TRUE(tied.Covisible(world.frames.back(), soon)) << "what was seen about there, too";
  EXPECT_FALSE(tied.Covisible(world.frames.back(), {-1}));
}

}  // namespace
}  // namespace sslcd
