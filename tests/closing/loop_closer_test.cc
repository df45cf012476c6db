// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_closer.h"

#include <algorithm>

#include "loop_closer_drive.h"

namespace sslcd {
namespace {

class LoopCloserTest : public LoopCloserDrive {};

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
  LoopOptions options = WithoutAdjustment();
  // Objects in sight show no error, so a tenth of this is learnt.
  options.odometry.translation_walk *= 10;
  options.odometry.rotation_walk *= 10;
  Start(Pose::Trans(4, 0, -3) * Pose::RotY(0.1), true, options);
  while (CountAccepted() == 0 && state_.frames.size() < world_.state.frames.size())
    DriveFrame(*closer_, state_);
  ASSERT_EQ(CountAccepted(), 1);
  const LoopMeasurement& loop = attempts().back().found.loop;
  EXPECT_LT(
      Apart(state_.frames[loop.match].T_world_cam.inverse() * state_.frames[loop.query].T_world_cam,
            world_.TrueLoop(loop.match, loop.query)),
      0.8)
      << "it was 5 m away";
  EXPECT_LT(state_.map.landmarks().size(), 2 * world_.trees.size());
  const auto now = [&](const std::pair<int, int>& sighting) {
    return state_.frames[sighting.first].matched[sighting.second];
  };
  EXPECT_EQ(attempts().back().pairs.size(), loop.row.pairs.size());
  for (const auto& [local, global] : attempts().back().pairs) EXPECT_EQ(now(local), now(global));
  EXPECT_EQ(timing_.Summary().at("drift correction").count, 1);
}

TEST_F(LoopCloserTest, TheTrackOfALoopContinuesAfterTheCorrection) {
  Start(SmallDrift(), WithoutAdjustment(), {});
  Drive();
  std::size_t first = 0;
  while (first < attempts().size() && !attempts()[first].accepted()) ++first;
  ASSERT_LT(first + 2, attempts().size());
  for (std::size_t i = first; i < attempts().size(); ++i) {
    if (attempts()[i].window.second) continue;
    EXPECT_EQ(attempts()[i].found.track, attempts()[first].found.track) << i - first;
  }
}

TEST_F(LoopCloserTest, LooksBackNearALoopWhileFramesCome) {
  LoopOptions options = WithoutAdjustment();
  for (const int look_back : {0, 4}) {
    options.layout.look_back = look_back;
    Start(SmallDrift(), options, {});
    Drive();
    int found = 0;
    for (const LoopAttempt& attempt : attempts()) {
      if (!attempt.window.second || !attempt.in_graph) continue;
      ++found;
      EXPECT_EQ(attempt.window.local_m, options.layout.hindsight_m);
      const LoopMeasurement& loop = attempt.found.loop;
      EXPECT_LT(Apart(loop.row.T_match_query, world_.TrueLoop(loop.match, loop.query)), 0.2);
    }
    EXPECT_EQ(found > 0, look_back > 0) << look_back;
  }
}

/// Keeps the windows of all searches.
class ListeningFinder : public LoopFinder {
 public:
  ListeningFinder(std::unique_ptr<LoopFinder> finder, std::vector<SearchWindow>& windows)
      : finder_(std::move(finder)), windows_(windows) {}
  std::unique_ptr<LoopFinder> Clone() const override {
    return std::make_unique<ListeningFinder>(finder_->Clone(), windows_);
  }
  std::optional<FoundLoop> Find(const FinderInput& input) override {
    windows_.push_back(input.window);
    return finder_->Find(input);
  }
  void MoveLocalMap(const YawShift& change) override { finder_->MoveLocalMap(change); }
  void Reset() override { finder_->Reset(); }

 private:
  std::unique_ptr<LoopFinder> finder_;
  std::vector<SearchWindow>& windows_;
};

TEST_F(LoopCloserTest, DoesNotLookBackToWhereThereIsNoOlderMap) {
  std::vector<SearchWindow> windows;
  LoopOptions options = WithoutAdjustment();
  options.layout.hindsight_m = 230;
  Start(SmallDrift(), options, {});
  closer_.emplace(options, WholeMapOptions(), Gallery::Mode::kByViewpoint,
                  std::make_unique<ListeningFinder>(MakeFinder(options, {}), windows));
  Drive();
  int second = 0;
  for (const SearchWindow& window : windows) {
    if (!window.second) continue;
    ++second;
    EXPECT_GT(window.GlobalMapEnd(options.layout.gap_m), 0);
  }
  EXPECT_GT(second, 4);
}

/// Finds true loops of the cameras at these lengths of path, once each: the first one in a first
/// search, the others in second ones. [m]
class ScriptedFinder : public LoopFinder {
 public:
  ScriptedFinder(const TwoPasses& world, std::vector<double> loops_m)
      : world_(world), loops_m_(std::move(loops_m)) {}
  std::unique_ptr<LoopFinder> Clone() const override {
    return std::make_unique<ScriptedFinder>(*this);
  }
  std::optional<FoundLoop> Find(const FinderInput& input) override {
    const double camera_m = input.window.end_m - input.window.lag_m;
    const auto loop = std::find(loops_m_.begin(), loops_m_.end(), camera_m);
    if (loop == loops_m_.end() || input.window.second == (loop == loops_m_.begin()))
      return std::nullopt;
    FoundLoop found;
    found.loop.match = 3;
    found.loop.query = input.state.frames.AtPath(camera_m);
    found.loop.row.decision = LoopDecision::kAccepted;
    found.loop.row.T_match_query = world_.TrueLoop(found.loop.match, found.loop.query);
    found.loop.row.covariance.setIdentity();
    return found;
  }

 private:
  const TwoPasses& world_;
  std::vector<double> loops_m_;
};

// 100 m to both sides of each loop: of those at 275, 180 and 80 m.
TEST_F(LoopCloserTest, LooksBackNoFartherThanAHundredMetresFromALoop) {
  std::vector<SearchWindow> windows;
  LoopOptions options = WithoutAdjustment();
  options.layout.look_back = 100;
  Start(Pose(), options, {});
  auto finder = std::make_unique<ScriptedFinder>(world_, std::vector<double>{275, 180, 80});
  closer_.emplace(options, WholeMapOptions(), Gallery::Mode::kByViewpoint,
                  std::make_unique<ListeningFinder>(std::move(finder), windows));
  Drive();
  std::vector<double> searched_m;
  for (const SearchWindow& window : windows)
    if (window.second) searched_m.push_back(window.end_m - window.lag_m);
  EXPECT_EQ(CountAccepted(), 3);
  ASSERT_FALSE(searched_m.empty());
  EXPECT_EQ(searched_m.front(), 175);
  for (double m = 50; m < 275; m += kEvery) {
    const auto times = std::count(searched_m.begin(), searched_m.end(), m);
    EXPECT_GE(times, 1) << m;
    if (m < 80 || m > 175) {
      EXPECT_EQ(times, 1) << "near one loop only, " << m;
    }
  }
}

TEST_F(LoopCloserTest, DoesNotLookBackWithoutASecondSearch) {
  LoopOptions options = WithoutAdjustment();
  options.layout.hindsight_m = 0;
  Start(SmallDrift(), options, {});
  Drive();
  for (const LoopAttempt& attempt : attempts()) EXPECT_FALSE(attempt.window.second);
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

TEST_F(LoopCloserTest, TheLatestCamerasHaveEarlyLoopsUntilTheirOwnAttempts) {
  Start(SmallDrift(), WithoutAdjustment(), {});
  std::size_t most = 0;
  while (state_.frames.size() < world_.state.frames.size()) {
    DriveFrame(*closer_, state_);
    const std::vector<LoopAttempt>& early = closer_->ledger().early();
    most = std::max(most, early.size());
    for (const LoopAttempt& attempt : early) {
      const LoopMeasurement& loop = attempt.found.loop;
      EXPECT_LT(Apart(loop.row.T_match_query, world_.TrueLoop(loop.match, loop.query)), 0.2);
      EXPECT_LT(state_.frames.back().travelled - state_.frames[loop.query].travelled,
                LoopOptions().lag_m + kEvery);
    }
  }
  EXPECT_EQ(most, 4u) << "20, 15, 10 and 5 m behind the newest camera";
  Finish();
  EXPECT_TRUE(closer_->ledger().early().empty());
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
    EXPECT_EQ(attempts()[i].window.end_m, world_.end_m());
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

}  // namespace
}  // namespace sslcd
