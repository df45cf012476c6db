// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_closer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "two_passes.h"

namespace sslcd {
namespace {

constexpr double kEvery = LoopLayoutOptions().every_m;

LoopOptions WithoutAdjustment() {
  LoopOptions options;
  options.adjust_keyframes = 0;
  return options;
}

double Apart(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

// Feeds the frames of TwoPasses to a loop closer, one by one. The host's matcher knows the trees.
class LoopCloserTest : public ::testing::Test {
 protected:
  void Start(const Pose& drift, bool accepts, const LoopOptions& options = WithoutAdjustment()) {
    accepts_ = accepts;
    Start(drift, options, [this](const PlaceQuery& query) { return Answer(query); });
  }
  void Start(const Pose& drift, const LoopOptions& options, const PlaceMatcher& matcher) {
    world_ = TwoPasses(drift);
    state_ = MapState{world_.state.map, {}};
    closer_.emplace(options, WholeMapOptions(), Gallery::Mode::kByViewpoint, matcher);
  }

  // The next frame continues from the current estimate of the previous one, by odometry.
  void DriveFrame(LoopCloser& closer, MapState& state) {
    const int i = state.frames.size();
    FrameRecord record = world_.state.frames[i];
    if (i > 0)
      record.T_world_cam = state.frames.back().T_world_cam *
                           state.frames.back().T_odom_cam.inverse() * record.T_odom_cam;
    for (LandmarkId& id : record.matched)
      if (state.map.landmarks().count(id.value) == 0) id = Twin(id);
    const std::vector<Detection> seen = record.detections;
    state.frames.Append(std::move(record));
    closer.AddFrame(state, seen);
    closer.AddKeyframe(state, 1., timing_);
  }
  void Drive(int end = 2 * TwoPasses::kFrames + 46) {
    while (state_.frames.size() <= end) DriveFrame(*closer_, state_);
  }
  void Finish() { closer_->Finish(state_, 1., timing_); }

  // Enters an accepted loop between frames midway on both passes, `off` the truth.
  void Accept(int query, const Pose& off = {}) {
    FoundLoop found;
    found.loop.match = TwoPasses::kFrames / 2;
    found.loop.query = query;
    found.loop.row.decision = LoopDecision::kAccepted;
    found.loop.row.T_match_query = world_.TrueLoop(found.loop.match, query) * off;
    found.sigma_m = 0.1;
    ASSERT_TRUE(closer_->ledger().Add(found, {state_.frames[query].travelled + 25, 25, 75, 0}, 0));
    closer_->ledger().AcceptNewest(state_.frames);
  }

  const std::vector<LoopAttempt>& attempts() const { return closer_->ledger().attempts(); }
  int CountAccepted() const { return static_cast<int>(closer_->ledger().AcceptedEdges().size()); }
  // Path from the query camera to the end of the local map, of the attempts from index `first` on.
  std::vector<double> Lags(std::size_t first) const {
    std::vector<double> lags;
    for (std::size_t i = first; i < attempts().size(); ++i)
      lags.push_back(attempts()[i].window.lag_m);
    return lags;
  }

  TwoPasses world_;
  MapState state_ = world_.state;
  std::optional<LoopCloser> closer_;
  TimingTable timing_;
  std::vector<double> asked_at_m_;

 private:
  std::optional<PlaceAnswer> Answer(const PlaceQuery& query) {
    asked_at_m_.push_back(state_.frames.back().travelled);
    PlaceAnswer answer;
    for (std::size_t i = 0; i < query.local.size(); ++i)
      for (std::size_t j = 0; j < query.global.size(); ++j)
        if (query.global[j].id == query.local[i].id ||
            query.global[j].id == Twin({query.local[i].id}).value)
          answer.matches.push_back({static_cast<int>(i), static_cast<int>(j)});
    answer.accepted = accepts_;
    if (answer.matches.size() < 4) return std::nullopt;
    return answer;
  }
  // The landmark of the same tree on the other pass.
  LandmarkId Twin(LandmarkId id) const {
    for (const auto& [early, late] : world_.trees) {
      if (id == early) return late;
      if (id == late) return early;
    }
    return {};
  }

  bool accepts_ = false;
};

TEST_F(LoopCloserTest, SearchesEveryFewMetresOfPath) {
  Start(Pose(), false);
  Drive();
  const LoopLayoutOptions layout;
  std::vector<double> expected;  // the first frame is as old as the end of the global map
  for (double m = layout.local_m + layout.gap_m; m <= world_.end_m(); m += kEvery)
    expected.push_back(m);
  EXPECT_EQ(asked_at_m_, expected);
  EXPECT_EQ(timing_.Summary().at("loop detection").count,
            static_cast<int>(world_.end_m() / kEvery));
}

TEST_F(LoopCloserTest, TheWindowsAreThoseOfTheOptions) {
  Start(Pose(), false);
  Drive();
  ASSERT_FALSE(attempts().empty());
  const LoopOptions options;
  for (const LoopAttempt& attempt : attempts()) {
    EXPECT_EQ(attempt.window.lag_m, options.lag_m);
    EXPECT_EQ(attempt.window.local_m, options.layout.local_m);
    EXPECT_EQ(attempt.window.beyond_m, 0);
  }
}

TEST_F(LoopCloserTest, ARefusedLoopIsListedAndChangesNothing) {
  Start(Pose::Trans(4, 0, -3), false);
  Drive();
  EXPECT_GT(attempts().size(), 3u);
  EXPECT_EQ(CountAccepted(), 0);
  for (int i = 0; i < state_.frames.size(); ++i)
    EXPECT_LT(Apart(state_.frames[i].T_world_cam, world_.state.frames[i].T_world_cam), 1e-9);
  EXPECT_EQ(state_.map.landmarks().size(), 2 * world_.trees.size());
  EXPECT_EQ(timing_.Summary().count("drift correction"), 0u);
}

TEST_F(LoopCloserTest, AnAcceptedLoopCorrectsTheTrajectoryAndFusesItsObjects) {
  Start(Pose::Trans(4, 0, -3) * Pose::RotY(0.1), true);
  while (CountAccepted() == 0 && state_.frames.size() < world_.state.frames.size())
    DriveFrame(*closer_, state_);
  ASSERT_EQ(CountAccepted(), 1);
  const LoopMeasurement& loop = attempts().back().found.loop;
  EXPECT_LT(
      Apart(state_.frames[loop.match].T_world_cam.inverse() * state_.frames[loop.query].T_world_cam,
            world_.TrueLoop(loop.match, loop.query)),
      0.2)
      << "it was 5 m away";
  EXPECT_LT(state_.map.landmarks().size(), 2 * world_.trees.size());
  for (const auto& [local, global] : attempts().back().pairs) EXPECT_EQ(local, global);
  EXPECT_EQ(timing_.Summary().at("drift correction").count, 1);
}

TEST_F(LoopCloserTest, TheTrackOfALoopContinuesAfterTheCorrection) {
  Start(Pose::Trans(4, 0, -3) * Pose::RotY(0.1), WithoutAdjustment(), {});
  Drive();
  std::size_t first = 0;
  while (first < attempts().size() && !attempts()[first].accepted()) ++first;
  ASSERT_LT(first + 2, attempts().size());
  for (std::size_t i = first; i < attempts().size(); ++i)
    EXPECT_EQ(attempts()[i].found.track, attempts()[first].found.track) << i - first;
}

// Without drift the first loop is where the trajectory has it; only its objects are fused.
TEST_F(LoopCloserTest, ALoopThatAgreesLeavesTheTrajectoryAsItIs) {
  Start(Pose(), true, LoopOptions());
  while (CountAccepted() == 0 && state_.frames.size() < world_.state.frames.size())
    DriveFrame(*closer_, state_);
  ASSERT_EQ(CountAccepted(), 1);
  EXPECT_EQ(state_.frames.revision(), static_cast<FrameStore::Revision>(state_.frames.size()));
  EXPECT_FALSE(attempts().back().solved);
  EXPECT_LT(state_.map.landmarks().size(), 2 * world_.trees.size());
}

TEST_F(LoopCloserTest, ACopyContinuesOnItsOwn) {
  Start(Pose(), false);
  Drive(150);
  const std::size_t before = attempts().size(), asked = asked_at_m_.size();
  LoopCloser copy = *closer_;
  MapState copied_state = state_;
  copy.AddKeyframe(copied_state, 1., timing_);
  EXPECT_EQ(asked_at_m_.size(), asked) << "it has just searched here";
  while (copied_state.frames.size() < world_.state.frames.size()) DriveFrame(copy, copied_state);
  EXPECT_GT(copy.ledger().attempts().size(), before);
  EXPECT_EQ(attempts().size(), before);
  Drive();
  ASSERT_EQ(attempts().size(), copy.ledger().attempts().size());
  for (std::size_t i = 0; i < attempts().size(); ++i)
    EXPECT_EQ(
        Apart(attempts()[i].row().T_match_query, copy.ledger().attempts()[i].row().T_match_query),
        0);
}

TEST_F(LoopCloserTest, FinishWithoutFramesDoesNothing) {
  Start(Pose(), true);
  Finish();
  EXPECT_TRUE(asked_at_m_.empty());
  EXPECT_TRUE(attempts().empty());
}

TEST_F(LoopCloserTest, FinishTiesTheLatestCameras) {
  Start(Pose(), false);
  Drive();
  const std::size_t first = attempts().size();
  Finish();
  EXPECT_EQ(Lags(first), (std::vector<double>{20, 15, 10, 5}));
  for (std::size_t i = first; i < attempts().size(); ++i) {
    EXPECT_EQ(attempts()[i].window.here_m, world_.end_m());
    EXPECT_EQ(attempts()[i].window.beyond_m, LoopOptions().lag_m);
  }
}

TEST_F(LoopCloserTest, FinishLeavesOutCamerasThatAnAcceptedLoopTies) {
  Start(Pose(), false);
  Drive();
  const std::size_t first = attempts().size();
  Accept(state_.frames.AtPath(world_.end_m() - 15 - 0.4 * kEvery));
  Accept(state_.frames.AtPath(world_.end_m() - 10 - 0.6 * kEvery));
  Finish();
  EXPECT_EQ(Lags(first + 2), (std::vector<double>{20, 10, 5}));
}

class SecondSearch : public LoopCloserTest {
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
  void AcceptNothing() { options_.acceptance.min_margin = 1e9; }

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
  DriveAndAccept();
  const int places = static_cast<int>((world_.end_m() - options_.lag_m) / kEvery);
  EXPECT_EQ(CountSearches(), kLatest + places - 1);
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

TEST_F(SecondSearch, KnowsOnlyLoopsThatAreStillAccepted) {
  AcceptNothing();
  DriveAndAccept();
  Accept(TwoPasses::kSecond + 31);
  closer_->ledger().attempts()[0].row().decision = LoopDecision::kAmbiguous;
  const double query_m = state_.frames[TwoPasses::kSecond + 30].travelled;
  const double match_m = state_.frames[TwoPasses::kFrames / 2].travelled;
  EXPECT_EQ(closer_->ledger().path().From(query_m).To(match_m), 0);
  Finish();
  EXPECT_EQ(closer_->ledger().path().From(query_m).To(match_m), 1);
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
    DriveOnly({}, Pose::Trans(4, 0, -3) * Pose::RotY(0.1));
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
