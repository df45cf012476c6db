// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "track_attempts.h"

namespace sslcd {
namespace {

TEST(PoseTracks, OneAttemptSaysWhatItsFitSays) {
  Attempts attempts(Strewn(60, 80, 1));
  EXPECT_TRUE(attempts.tracks.tracks().empty());
  attempts.Update(attempts.SeenAt(10, 5), 100);
  ASSERT_FALSE(attempts.tracks.tracks().empty());
  const PoseTrack& best = attempts.tracks.tracks()[0];
  EXPECT_LT(ShiftBetween(best.pose, kPose, attempts.SeenAt(10, 5)[0].position), 0.5);
  EXPECT_NEAR(best.evidence, best.fit.evidence, 1e-9);
  EXPECT_GT(best.evidence, 0);
  for (std::size_t i = 1; i < attempts.tracks.tracks().size(); ++i)
    EXPECT_LE(attempts.tracks.tracks()[i].evidence, attempts.tracks.tracks()[i - 1].evidence);
}

// Both turn the local map by the same, one about its objects, the other about a distant origin.
TEST(PoseTracks, PosesAreComparedWhereTheObjectsAre) {
  Attempts attempts(Strewn(60, 80, 1));
  const PoseSearchOptions& search = attempts.match.search;
  const Vec3 centre(300, 100, 0);
  std::vector<LayoutObject> local;
  for (const double x : {-10., 0., 4., 6.}) local.push_back(ObjectAt(centre + Vec3(x, -x, 0)));
  const LayoutLikelihood likelihood(local, attempts.index, attempts.match.likelihood);
  const double turn = 0.9 * search.distinct_rad;
  const YawShift about_origin{turn, {0, 0, 0}},
      about_objects{turn, centre - Apply(about_origin, centre)};
  for (const YawShift& turned : {about_origin, about_objects}) {
    PoseTracks tracks({});
    tracks.Update(likelihood, {{YawShift{}, {}}, {turned, {}}}, search, 100, 0, NoPrior);
    EXPECT_EQ(tracks.tracks().size(), turned.t.norm() > 0 ? 1u : 2u);
  }
}

TEST(PoseTracks, ThePriorCounts) {
  Attempts without(Strewn(60, 80, 1)), with(Strewn(60, 80, 1));
  const auto local = without.SeenAt(10, 5);
  without.Update(local, 100);
  with.Update(local, 100, [](const YawShift&, const LayoutFit&) { return PosePrior{-1, -2}; });
  EXPECT_NEAR(with.tracks.tracks()[0].evidence, without.tracks.tracks()[0].evidence - 3, 1e-9);
  EXPECT_EQ(with.tracks.tracks()[0].prior.level, -1);
  EXPECT_EQ(with.tracks.tracks()[0].prior.height, -2);
}

TEST(PoseTracks, TheSameObjectsAgainSayNothingNew) {
  Attempts attempts(Strewn(60, 80, 1));
  const auto local = attempts.SeenAt(10, 5);
  attempts.Update(local, 100);
  const PoseTrack first = attempts.tracks.tracks()[0];
  for (int i = 1; i <= 5; ++i) attempts.Update(local, 100 + 5 * i);
  const PoseTrack& last = attempts.tracks.tracks()[0];
  EXPECT_EQ(last.id, first.id);
  EXPECT_EQ(last.votes.size(), 6u);
  EXPECT_NEAR(last.evidence, first.evidence, 1e-3);
}

TEST(PoseTracks, NewObjectsDo) {
  Attempts attempts(Strewn(120, 120, 1));
  attempts.Update(attempts.SeenAt(-20, 0), 100);
  const PoseTrack first = attempts.tracks.tracks()[0];
  for (int i = 1; i <= 8; ++i)
    attempts.UpdateWithoutSearch(attempts.SeenAt(-20 + 5 * i, 0), 100 + 5 * i);
  ASSERT_FALSE(attempts.tracks.tracks().empty());
  const PoseTrack& last = attempts.tracks.tracks()[0];
  EXPECT_EQ(last.id, first.id) << "followed, not found again";
  EXPECT_GT(last.evidence, 1.5 * first.evidence);
}

// The search finds no pose in the first three attempts, and the right one in the fourth.
PoseTrack FoundLate(double level, double first_m = 100) {
  Attempts attempts(Strewn(120, 120, 1));
  for (int i = 0; i < 3; ++i)
    attempts.UpdateWithoutSearch(attempts.SeenAt(-10 + 5 * i, 0), first_m + 5 * i);
  attempts.Update(attempts.SeenAt(5, 0), 115, [=](const YawShift&, const LayoutFit&) {
    return PosePrior{level, 0};
  });
  return attempts.tracks.tracks().at(0);
}

TEST(PoseTracks, APoseThatOdometryDoesNotExcludeIsFollowedBack) {
  const PoseTrack followed = FoundLate(-5), fresh = FoundLate(-12);
  ASSERT_EQ(followed.votes.size(), 4u);
  EXPECT_EQ(fresh.votes.size(), 1u) << "odometry excludes it";
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(followed.votes[i].path_m, 100. + 5. * double(i));
  EXPECT_GT(followed.evidence, fresh.evidence + 7 + 1) << "by the objects seen before";
  EXPECT_EQ(FoundLate(2, 0).votes.size(), 1u) << "the others are more than 100 m back";
}

// The map of now has the objects of the earlier attempts themselves, which fit wherever a row
// repeats.
TEST(PoseTracks, APoseIsFollowedBackInTheMapOfThen) {
  std::vector<LayoutObject> map = Strewn(120, 120, 1);
  for (LayoutObject& object : map) object.since_m = 50;
  Attempts attempts(map);
  for (const double map_end_m : {50., 51.}) {
    attempts.tracks.Forget();
    attempts.map_end_m = map_end_m;
    attempts.UpdateWithoutSearch(attempts.SeenAt(0, 0), 100);
    attempts.map_end_m = 60;
    attempts.Update(attempts.SeenAt(5, 0), 105);
    EXPECT_EQ(attempts.tracks.tracks().at(0).votes.size(), map_end_m > 50 ? 2u : 1u);
  }
}

TEST(PoseTracks, WhatLiesFarBackIsForgotten) {
  PoseTrackOptions options;
  options.agree_m = 12;
  Attempts attempts(Strewn(60, 80, 1), options);
  for (const double path : {0., 5., 10., 15., 20.}) attempts.Update(attempts.SeenAt(10, 5), path);
  const std::vector<PoseTrack::Vote>& votes = attempts.tracks.tracks()[0].votes;
  ASSERT_EQ(votes.size(), 3u);
  EXPECT_EQ(votes.front().path_m, 10);
}

TEST(PoseTracks, EndWhereTheLayoutsNoLongerAgree) {
  Attempts attempts(Strewn(60, 80, 1));
  attempts.Update(attempts.SeenAt(10, 5), 100);
  attempts.UpdateWithoutSearch({}, 105);
  EXPECT_FALSE(attempts.tracks.tracks().empty()) << "nothing seen says nothing";
  attempts.UpdateWithoutSearch({ObjectAt({1000, 0, 0}), ObjectAt({1010, 0, 0})}, 110);
  EXPECT_TRUE(attempts.tracks.tracks().empty());
}

TEST(PoseTracks, TwinsHaveNoMargin) {
  std::vector<LayoutObject> map = Strewn(20, 40, 4);
  for (int i = 0; i < 20; ++i)
    map.push_back(ObjectAt(map[i].position + Vec3(300, 0, 0), map[i].label));
  Attempts attempts(map);
  const auto local = attempts.SeenAt(0, 0, 25);
  attempts.Update(local, 100);
  ASSERT_GE(attempts.tracks.tracks().size(), 2u);
  EXPECT_GT(attempts.tracks.tracks()[1].evidence, 5);
  EXPECT_NEAR(attempts.tracks.Margin(0), 0, 0.1);
  EXPECT_NEAR(attempts.tracks.Margin(1), 0, 0.1);
  // A prior settles it: the margin is that of the two, as "nowhere" is far behind.
  attempts.Update(local, 105, [](const YawShift& pose, const LayoutFit&) {
    return PosePrior{pose.t.x() > 150 ? -4. : 0., 0};
  });
  EXPECT_NEAR(attempts.tracks.Margin(0), 4, 0.2);
  EXPECT_NEAR(attempts.tracks.Margin(1), -4, 0.2);
}

TEST(PoseTracks, StartAgainUnderNewNames) {
  Attempts attempts(Strewn(60, 80, 1));
  attempts.Update(attempts.SeenAt(10, 5), 100);
  ASSERT_FALSE(attempts.tracks.tracks().empty());
  const PoseTrack before = attempts.tracks.tracks()[0];
  attempts.tracks.Forget();
  EXPECT_TRUE(attempts.tracks.tracks().empty());
  attempts.Update(attempts.SeenAt(10, 5), 100);
  ASSERT_FALSE(attempts.tracks.tracks().empty());
  const PoseTrack& now = attempts.tracks.tracks()[0];
  EXPECT_GT(now.id, before.id);
  EXPECT_EQ(now.votes.size(), 1u);
  EXPECT_NEAR(now.evidence, before.evidence, 1e-9);
}

TEST(PoseTracks, FollowAChangeOfCoordinates) {
  Attempts attempts(Strewn(60, 80, 1));
  attempts.Update(attempts.SeenAt(10, 5), 100);
  const YawShift before = attempts.tracks.tracks()[0].pose;
  const YawShift change{-2.9, {12, 5, -3}};
  attempts.tracks.Move(change);
  const YawShift after = attempts.tracks.tracks()[0].pose;
  for (const Vec3& point : {Vec3(0, 0, 0), Vec3(10, 0, 1), Vec3(-3, 7, 2)})
    EXPECT_NEAR((Apply(after, Apply(change, point)) - Apply(before, point)).norm(), 0, 1e-9);
  EXPECT_LE(std::abs(after.yaw), M_PI);
}

TEST(PoseTracks, EvidenceGrowsWithWhatIsNewInTheLocalMaps) {
  Attempts attempts(Strewn(60, 80, 1));
  const auto first = attempts.SeenAt(4, 5), second = attempts.SeenAt(18, 0);
  attempts.Update(first, 100);
  attempts.Update(second, 105);
  std::set<int> different;
  for (const auto* local : {&first, &second})
    for (const LayoutObject& object : *local) different.insert(object.id);
  ASSERT_LT(different.size(), first.size() + second.size());
  ASSERT_GT(different.size(), first.size());
  const PoseTrack& track = attempts.tracks.tracks()[0];
  ASSERT_EQ(track.votes.size(), 2u);
  const double volume = track.fit.evidence - track.fit.score,
               mean_score = (track.votes[0].score + track.votes[1].score) / 2,
               mean_objects = static_cast<double>(first.size() + second.size()) / 2;
  EXPECT_NEAR(track.evidence,
              volume + mean_score * static_cast<double>(different.size()) / mean_objects, 1e-9);
}

// Odds of "nowhere": of chance, or of a place that looks like the best one but for the priors
// against it.
double OddsOfNowhere(const std::vector<PoseTrack>& tracks, double look_alike) {
  double best = 0;
  for (const PoseTrack& track : tracks)
    best = std::max(
        best, std::exp(track.evidence - track.prior.height - std::min(0., track.prior.level)));
  return 1 + look_alike * best;
}

TEST(PoseTracks, MarginIsTheLogOddsAgainstAllOthersAndNowhere) {
  std::vector<LayoutObject> grid;
  for (int i = 0; i < 30; ++i) grid.push_back(ObjectAt({2.5 * (i % 6), 6. * (i / 6), 0}));
  for (const double look_alike : {0.5, 1e-2, 1e-12}) {
    PoseTrackOptions options;
    options.look_alike = look_alike;
    Attempts attempts(grid, options);
    attempts.Update(attempts.SeenAt(5, 12, 7.5), 100, [](const YawShift& pose, const LayoutFit&) {
      return PosePrior{0.1 * pose.t.x() - 3, -0.1 * std::abs(pose.t.y())};
    });
    const std::vector<PoseTrack>& tracks = attempts.tracks.tracks();
    ASSERT_GE(tracks.size(), 3u);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      double others = OddsOfNowhere(tracks, look_alike);
      for (std::size_t j = 0; j < tracks.size(); ++j)
        if (j != i) others += std::exp(tracks[j].evidence);
      EXPECT_NEAR(attempts.tracks.Margin(i), tracks[i].evidence - std::log(others), 1e-9);
    }
  }
}

// Rivals are in the map: nothing that looks alike limits what odometry says of one against another.
TEST(PoseTracks, TwoRivalsAreComparedInFull) {
  std::vector<LayoutObject> map = Strewn(20, 40, 4);
  for (int i = 0; i < 20; ++i)
    map.push_back(ObjectAt(map[i].position + Vec3(300, 0, 0), map[i].label));
  for (const double against : {2., 50., 1000.}) {
    Attempts attempts(map);
    attempts.Update(attempts.SeenAt(0, 0, 25), 100, [&](const YawShift& pose, const LayoutFit&) {
      return PosePrior{pose.t.x() > 150 ? -against : 0., 0};
    });
    const std::vector<PoseTrack>& tracks = attempts.tracks.tracks();
    ASSERT_GE(tracks.size(), 2u);
    EXPECT_NEAR(tracks[0].evidence - tracks[1].evidence, against, 0.1);
    EXPECT_NEAR(attempts.tracks.Margin(1), -against, 0.2);
  }
}

TEST(PoseTracks, MarginHoldsWhereEvidenceIsBeyondTheRangeOfExp) {
  std::vector<LayoutObject> map = Strewn(20, 40, 4);
  for (int i = 0; i < 20; ++i)
    map.push_back(ObjectAt(map[i].position + Vec3(300, 0, 0), map[i].label));
  PoseTrackOptions options;
  options.look_alike = 1e-12;
  Attempts attempts(map, options);
  attempts.Update(attempts.SeenAt(0, 0, 25), 100, [](const YawShift& pose, const LayoutFit&) {
    return PosePrior{pose.t.x() > 150 ? 2000. : 1990., 0};
  });
  ASSERT_GE(attempts.tracks.tracks().size(), 2u);
  const double apart = attempts.tracks.tracks()[0].evidence - attempts.tracks.tracks()[1].evidence;
  EXPECT_NEAR(attempts.tracks.Margin(0), apart, 1e-6);
  EXPECT_NEAR(attempts.tracks.Margin(1), -apart, 1e-4);
}

TEST(PoseTracks, VotesCountFromAgreeMBackOn) {
  PoseTrackOptions options;
  options.agree_m = 10;
  Attempts attempts(Strewn(60, 80, 1), options);
  for (const double path : {0., 5., 10., 15., 20.}) attempts.Update(attempts.SeenAt(10, 5), path);
  EXPECT_EQ(attempts.tracks.tracks()[0].votes.front().path_m, 10);
}

TEST(PoseTracks, FollowedWithAsManyMatchesAsHaveToAgree) {
  Attempts attempts(Strewn(60, 80, 1));
  auto four = attempts.SeenAt(10, 5);
  four.resize(4);
  attempts.match.search.min_matches = 4;
  attempts.Update(four, 100);
  ASSERT_FALSE(attempts.tracks.tracks().empty());
  attempts.UpdateWithoutSearch(four, 105);
  EXPECT_FALSE(attempts.tracks.tracks().empty());
  attempts.match.search.min_matches = 5;
  attempts.UpdateWithoutSearch(four, 110);
  EXPECT_TRUE(attempts.tracks.tracks().empty());
}

TEST(PoseTracks, AHypothesisThatJumpsIsAnotherOne) {
  const Vec3 jump(0.8, 0.6, 0);  // 1 m
  for (const double step_m : {0.8, 1.2}) {
    PoseTrackOptions options;
    options.step_m = step_m;
    Attempts attempts(Strewn(60, 80, 1), options);
    auto local = attempts.SeenAt(10, 5);
    attempts.Update(local, 100);
    for (LayoutObject& object : local) object.position += jump;
    attempts.UpdateWithoutSearch(local, 105);
    EXPECT_EQ(attempts.tracks.tracks().empty(), step_m < 1);
  }
  for (const double step_rad : {0.02, 0.04}) {
    PoseTrackOptions options;
    options.step_rad = step_rad;
    Attempts attempts(Strewn(60, 80, 1), options);
    auto local = attempts.SeenAt(10, 5);
    attempts.Update(local, 100);
    for (LayoutObject& object : local) object.position = Apply({0.03, {0, 0, 0}}, object.position);
    attempts.UpdateWithoutSearch(local, 105);
    EXPECT_EQ(attempts.tracks.tracks().empty(), step_rad < 0.03);
  }
}

TEST(PoseTracks, TheBestOnesAreFollowed) {
  std::vector<LayoutObject> grid;
  for (int i = 0; i < 30; ++i) grid.push_back(ObjectAt({2.5 * (i % 6), 6. * (i / 6), 0}));
  Attempts all(grid);
  all.Update(all.SeenAt(5, 12, 7.5), 100);
  ASSERT_GE(all.tracks.tracks().size(), 3u);
  PoseTrackOptions options;
  options.max_tracks = 2;
  Attempts two(grid, options);
  two.Update(two.SeenAt(5, 12, 7.5), 100);
  ASSERT_EQ(two.tracks.tracks().size(), 2u);
  for (const std::size_t i : {0, 1})
    EXPECT_EQ(two.tracks.tracks()[i].evidence, all.tracks.tracks()[i].evidence);
}

TEST(PoseTracks, NowhereHasAMarginToo) {
  Attempts attempts(Strewn(60, 80, 1));
  attempts.Update(attempts.SeenAt(10, 5), 100);
  const std::vector<PoseTrack>& tracks = attempts.tracks.tracks();
  ASSERT_FALSE(tracks.empty());
  double sum = 0;
  for (const PoseTrack& track : tracks) sum += std::exp(track.evidence);
  const double nowhere = OddsOfNowhere(tracks, PoseTrackOptions().look_alike);
  EXPECT_NEAR(attempts.tracks.Margin(tracks.size()), std::log(nowhere / sum), 1e-9);
}

}  // namespace
}  // namespace sslcd
