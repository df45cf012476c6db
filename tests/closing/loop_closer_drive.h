// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "closing/loop_closer.h"
#include "closing/loop_finder.h"
#include "two_passes.h"

namespace sslcd {

/// Feeds the frames of TwoPasses to a loop closer, one by one. The host's matcher knows the trees.
class LoopCloserDrive : public ::testing::Test {
 protected:
  static constexpr double kEvery = LoopLayoutOptions().every_m;

  // What this odometry, which errs on the detour alone, may be off by: objects in sight show no
  // error, so a tenth of the noise is learnt.
  static Pose SmallDrift() { return Pose::Trans(0.4, 0, -0.3) * Pose::RotY(0.01); }
  static LoopOptions WithoutAdjustment() {
    LoopOptions options;
    options.adjust_keyframes = 0;
    return options;
  }
  static double Apart(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

  void Start(const Pose& drift, bool accepts, const LoopOptions& options = WithoutAdjustment()) {
    accepts_ = accepts;
    Start(drift, options, [this](const PlaceQuery& query) { return Answer(query); });
  }
  void Start(const Pose& drift, const LoopOptions& options, const PlaceMatcher& matcher) {
    world_ = TwoPasses(drift);
    state_ = MapState{world_.state.map, {}};
    closer_.emplace(options, WholeMapOptions(), Gallery::Mode::kByViewpoint,
                    MakeFinder(options, matcher));
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
  void Finish() {
    closer_->SearchAtEnd(state_, 1., timing_);
    closer_->SearchAgain(state_, 1., timing_);
  }

  // Enters an accepted loop between frames midway on both passes, `off` the truth.
  void Accept(int query, const Pose& off = {}) {
    FoundLoop found;
    found.loop.match = TwoPasses::kFrames / 2;
    found.loop.query = query;
    found.loop.row.decision = LoopDecision::kAccepted;
    found.loop.row.T_match_query = world_.TrueLoop(found.loop.match, query) * off;
    found.sigma_m = 0.1;
    ASSERT_TRUE(closer_->ledger().Add(found, {state_.frames[query].travelled + 25, 25, 75, 0}, 0));
    closer_->ledger().AcceptNewest();
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

}  // namespace sslcd
