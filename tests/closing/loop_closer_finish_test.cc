// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>

#include "loop_closer_drive.h"
#include "refine/fuse.h"

namespace sslcd {
namespace {

class SecondSearch : public LoopCloserDrive {
 protected:
  SecondSearch() { options_.adjust_keyframes = 0; }

  // Drives without a search and enters an accepted loop.
  void DriveAndAccept(const PlaceMatcher& matcher = {}) {
    DriveOnly(matcher);
    Accept(TwoPasses::kSecond + 30);
  }
  void DriveOnly(const PlaceMatcher& matcher = {}, const Pose& drift = {}) {
    Start(drift, options_, matcher);
    for (const FrameRecord& record : world_.state.frames) {
      state_.frames.Append(record);
      closer_->AddFrame(state_, record.detections);
    }
  }
  // Number of searches by Finish.
  int CountSearches() {
    Finish();
    return timing_.Summary().at("loop detection").count;
  }
  void AcceptNothing() { options_.acceptance.max_risk = 0; }

  static constexpr int kLatest = 4;  // searches for the latest cameras, see FinishTiesTheLatest...
  LoopOptions options_;
};

TEST_F(SecondSearch, GoesAlongTheWholeRunAndKeepsTheAcceptedLoops) {
  DriveAndAccept();
  Finish();
  std::set<int> first_tracks;
  for (const LoopAttempt& attempt : attempts())
    if (attempt.window.local_m == options_.layout.local_m) first_tracks.insert(attempt.found.track);
  int found = 0;
  for (const LoopAttempt& attempt : attempts()) {
    if (attempt.window.local_m != options_.layout.hindsight_m) continue;
    ++found;
    EXPECT_TRUE(attempt.in_graph);
    EXPECT_EQ(first_tracks.count(attempt.found.track), 0u) << "it starts without tracks";
    EXPECT_EQ(attempt.window.lag_m, options_.lag_m);
    EXPECT_EQ(attempt.window.beyond_m, options_.lag_m);
    const LoopMeasurement& loop = attempt.found.loop;
    EXPECT_LT(Apart(loop.row.T_match_query, world_.TrueLoop(loop.match, loop.query)), 0.1);
  }
  EXPECT_GT(found, 3);
}

TEST_F(SecondSearch, LeavesOutCamerasThatAnAcceptedLoopTies) {
  AcceptNothing();
  for (const int beside_m : {-2, 0, 2}) {  // less than half of the path between two places
    DriveOnly();
    Accept(TwoPasses::kSecond + 30 + beside_m);
    const int places = static_cast<int>((world_.end_m() - options_.lag_m) / kEvery);
    timing_ = {};
    EXPECT_EQ(CountSearches(), kLatest + places - 1) << beside_m;
  }
}

TEST_F(SecondSearch, DropsWhatItDoesNotAccept) {
  AcceptNothing();
  DriveAndAccept();
  Finish();
  EXPECT_EQ(CountAccepted(), 1);
  for (const LoopAttempt& attempt : attempts())
    EXPECT_NE(attempt.window.local_m, options_.layout.hindsight_m);
  EXPECT_GT(attempts().size(), 1u) << "those of the first search stay";
}

TEST_F(SecondSearch, NotWithoutAnAcceptedLoop) {
  AcceptNothing();
  DriveOnly();
  EXPECT_EQ(CountSearches(), kLatest);
}

TEST_F(SecondSearch, NotWhereItIsOff) {
  AcceptNothing();
  options_.layout.hindsight_m = 0;
  DriveAndAccept();
  EXPECT_EQ(CountSearches(), kLatest);
}

TEST_F(SecondSearch, NotWithAHostsMatcher) {
  DriveAndAccept([](const PlaceQuery&) { return std::nullopt; });
  EXPECT_EQ(CountSearches(), kLatest);
}

class Adjustment : public SecondSearch {};

// The drift and an odometry that contradicts the objects a little.
TEST_F(Adjustment, FollowsACorrectionUpToANumberOfKeyframes) {
  std::vector<std::vector<Pose>> results;
  for (const int keyframes : {0, 500}) {
    options_.adjust_keyframes = keyframes;
    DriveOnly({}, SmallDrift());
    Finish();
    EXPECT_GT(CountAccepted(), 0);
    results.push_back(PosesOf(state_.frames));
  }
  double largest = 0;
  for (std::size_t i = 0; i < results[0].size(); ++i)
    largest = std::max(largest, Apart(results[0][i], results[1][i]));
  EXPECT_GT(largest, 1e-3);
}

class Review : public SecondSearch {};

TEST_F(Review, WithdrawsALoopThatTheTrajectoryContradicts) {
  for (const double share : {0.9, 1.1}) {
    DriveOnly();
    Accept(TwoPasses::kSecond + 30, Pose::Trans(share * options_.acceptance.withdraw_m, 0, 0));
    closer_->Review(state_);
    EXPECT_EQ(CountAccepted(), share < 1 ? 1 : 0);
  }
}

TEST_F(Review, SplitsWhatWithdrawnLoopsHaveFused) {
  options_.layout.hindsight_m = 0;
  DriveOnly();
  const std::size_t count = state_.map.landmarks().size();
  Finish();
  ASSERT_GT(CountAccepted(), 0);
  ASSERT_LT(state_.map.landmarks().size(), count);
  EXPECT_FALSE(closer_->Review(state_)) << "the trajectory agrees";
  EXPECT_LT(state_.map.landmarks().size(), count);
  for (int i = TwoPasses::kSecond; i < state_.frames.size(); ++i)
    state_.frames.SetPose(i, Pose::Trans(3, 0, 0) * state_.frames[i].T_world_cam);
  EXPECT_TRUE(closer_->Review(state_));
  EXPECT_EQ(CountAccepted(), 0);
  EXPECT_EQ(state_.map.landmarks().size(), count);
  EXPECT_FALSE(closer_->Review(state_)) << "once";
}

// The refinement has moved the map, so poses of tracks are those of another one.
TEST_F(Review, ForgetsTheTracks) {
  AcceptNothing();
  for (const bool reviewed : {false, true}) {
    DriveOnly();
    closer_->AddKeyframe(state_, 1., timing_);
    ASSERT_EQ(attempts().size(), 1u);
    if (reviewed) closer_->Review(state_);
    Finish();
    ASSERT_GT(attempts().size(), 1u);
    EXPECT_EQ(attempts()[0].found.track == attempts()[1].found.track, !reviewed);
  }
}

// The refinement has associated the frames again: both passes see the same landmarks now.
TEST_F(Review, MeasuresTheOtherLoopsByTheNewAssociation) {
  DriveOnly();
  Accept(TwoPasses::kSecond + 30, Pose::Trans(0.4, 0, -0.3));
  MergedIds merged;
  for (const auto& [early, late] : world_.trees) {
    state_.map.Fuse(early, late);
    merged[late.value] = early;
  }
  for (int i = 0; i < state_.frames.size(); ++i) {
    std::vector<LandmarkId> matched = state_.frames[i].matched;
    for (LandmarkId& id : matched) id = Resolve(id, merged);
    state_.frames.SetMatched(i, matched);
  }
  closer_->Review(state_);
  ASSERT_TRUE(attempts()[0].remeasured);
  EXPECT_LT(Apart(attempts()[0].remeasured->T_match_query,
                  world_.TrueLoop(TwoPasses::kFrames / 2, TwoPasses::kSecond + 30)),
            1e-3);
}

}  // namespace
}  // namespace sslcd
