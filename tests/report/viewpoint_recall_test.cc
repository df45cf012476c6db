// SPDX-License-Identifier: BSD-3-Clause
#include "report/viewpoint_recall.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/loop_truth.h"

namespace sslcd {
namespace {

// 200 m straight on and back beside it, a frame each metre. The world is turned by R.
RunView OutAndBack(const Pose& T_world_level = Pose()) {
  RunView run;
  for (int i = 0; i < 400; ++i) {
    const bool back = i >= 200;
    const Vec3 at(back ? 3 : 0, 0, back ? 399 - i : i);
    const Pose turn = Pose::Exp((Vec6() << 0, 0, 0, 0, back ? M_PI : 0, 0).finished());
    run.trajectory.stamps.push_back(.1 * i);
    run.trajectory.poses.push_back(T_world_level * Pose(turn.so3(), at));
  }
  run.odometry = run.truth = run.trajectory;
  return run;
}

LoopClosure Loop(const RunView& run, int query, int match, double off_m) {
  LoopClosure loop;
  loop.decision = LoopDecision::kAccepted;
  loop.query_frame = query;
  loop.match_frame = match;
  loop.viewpoint_change_rad = M_PI;
  loop.T_match_query = run.truth.poses[std::size_t(match)].inverse() *
                       run.truth.poses[std::size_t(query)] * Pose::Trans(off_m, 0, 0);
  return loop;
}

std::vector<ViewpointCounts> RecallOf(const RunView& run) {
  return ViewpointRecall(run, TrueRows(run));
}

TEST(ViewpointRecall, CountsPlacesAndLoopsOfTheWayBack) {
  RunView run = OutAndBack();
  const int revisits = RecallOf(run)[11].revisits;
  EXPECT_GT(revisits, 25) << "a place each 5 m, but for the last 60 m before the turn";
  EXPECT_LT(revisits, 36);
  EXPECT_EQ(RecallOf(run)[11].recognised, 0);
  run.loops = {Loop(run, 300, 99, 0), Loop(run, 350, 49, 6)};
  const std::vector<ViewpointCounts> bins = RecallOf(run);
  ASSERT_EQ(bins.size(), 12u);
  EXPECT_EQ(bins[11].revisits, revisits);
  EXPECT_GE(bins[11].recognised, 2) << "the keyframes within 5 m of the right loop";
  EXPECT_LE(bins[11].recognised, 3);
  EXPECT_EQ(bins[11].loops, 2);
  EXPECT_EQ(bins[11].right, 1);
  for (std::size_t i = 0; i < 11; ++i) EXPECT_EQ(bins[i].revisits + bins[i].loops, 0);
  run.loops[0].decision = LoopDecision::kAmbiguous;
  EXPECT_EQ(RecallOf(run)[11].recognised, 0) << "refused";
}

TEST(ViewpointRecall, BinsLoopsByTheirTrueCamerasOnly) {
  RunView run = OutAndBack();
  run.loops = {Loop(run, 300, 99, 0)};
  run.loops[0].viewpoint_change_rad = 0;  // its own, wrong estimate
  EXPECT_EQ(RecallOf(run)[11].right, 1);
  EXPECT_EQ(RecallOf(run)[0].loops, 0);
}

TEST(ViewpointRecall, IsTheSameForEachUpAxis) {
  const RunView level = OutAndBack();
  const Pose T_world_level(Pose::Exp((Vec6() << 0, 0, 0, -M_PI / 2, 0, 0).finished()).so3(),
                           Vec3(5, 6, 7));
  RunView run = OutAndBack(T_world_level);
  run.gravity = GravityFrame::FromUp(T_world_level.so3() * Vec3(0, -1, 0));
  EXPECT_EQ(RecallOf(run)[11].revisits, RecallOf(level)[11].revisits);
}

TEST(ViewpointRecall, IsSilentWithoutTrueTimes) {
  RunView run = OutAndBack();
  for (std::size_t i = 0; i < 50; ++i) run.truth.stamps[i] += .02;
  EXPECT_TRUE(RecallOf(run).empty());
  run.truth = {};
  EXPECT_TRUE(RecallOf(run).empty());
  EXPECT_TRUE(RecallOf(RunView()).empty());
}

}  // namespace
}  // namespace sslcd
