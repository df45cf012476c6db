// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/closing/place_matcher.h"

#include "eval/sequence_metrics.h"
#include "loop_drives.h"
#include "sslcd/core/error.h"
#include "sslcd/loop/layout_match.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

RunResult RunWith(const Drives& drives, PlaceMatcher matcher, const Options& options = {}) {
  MapperContext context = drives.Context();
  context.place_matcher = std::move(matcher);
  return RunSequence(drives.frames, context, options);
}

// sslcd's own matching of two layouts, without anything that it knows from earlier attempts.
std::optional<PlaceAnswer> MatchOnce(const PlaceQuery& query) {
  const LayoutAnswer found = MatchLayouts(query.local, query.global);
  if (found.hypotheses.empty()) return std::nullopt;
  PlaceAnswer answer;
  answer.matches = found.hypotheses[0].fit.matches;
  answer.score = found.score;
  answer.accepted = found.decision == LoopDecision::kAccepted && found.score > 5;
  return answer;
}

TEST(PlaceMatcher, ClosesLoops) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.3, 1);
  const RunResult result = RunWith(drives, MatchOnce);
  const SequenceMetrics metrics = drives.Judge(result);
  EXPECT_GT(metrics.loops, 10);
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_LT(metrics.ate, 0.35 * metrics.ate_odometry);
  ExpectGoodRows(result);
}

TEST(PlaceMatcher, UnsureAnswersChangeNothing) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.3, 2);
  int asked = 0, about_newest = 0;
  const RunResult result = RunWith(drives, [&](const PlaceQuery& query) {
    ++asked;
    about_newest += query.frame == drives.frames.back().index;
    EXPECT_LT(query.old_frame, query.frame);
    EXPECT_FALSE(query.local.empty());
    auto answer = MatchOnce(query);
    if (answer) answer->accepted = false;
    return answer;
  });
  EXPECT_GT(asked, 50);
  EXPECT_GE(about_newest, 4) << "at the end, for the cameras further back";
  EXPECT_GT(result.loops.size(), 20u);
  EXPECT_EQ(Accepted(result), 0);
  for (const LoopClosure& loop : result.loops) EXPECT_LE(loop.query_frame, loop.newest_frame);

  Options none;
  none.loop.enabled = false;
  const RunResult without = drives.Run(none);
  ASSERT_EQ(result.trajectory.size(), without.trajectory.size());
  for (std::size_t i = 0; i < without.trajectory.size(); ++i)
    EXPECT_LT((result.trajectory.poses[i].inverse() * without.trajectory.poses[i]).Log().norm(),
              1e-9);
}

TEST(PlaceMatcher, ImagesTieTwoCameras) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.3, 3);
  const auto& truth = drives.world.truth.poses;
  Options options;
  options.refine.enabled = false;
  options.loop.adjust_keyframes = 0;
  const auto from_truth = [&](const PlaceQuery& query) -> std::optional<PlaceAnswer> {
    for (int old = 0; old <= query.old_frame; ++old) {
      const Pose T_old_new = truth[old].inverse() * truth[query.frame];
      if (T_old_new.translation().norm() < 1) return PlaceAnswer{{}, old, T_old_new, 7., true};
    }
    return std::nullopt;
  };
  const RunResult result = RunWith(drives, from_truth, options);
  const SequenceMetrics metrics = drives.Judge(result);
  EXPECT_GT(metrics.loops, 20);
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_LT(metrics.ate, 0.35 * metrics.ate_odometry);
  for (const LoopClosure& loop : result.loops) {
    EXPECT_EQ(loop.query_frame, loop.newest_frame);
    EXPECT_LT(loop.viewpoint_change_rad, 0.2);
    EXPECT_EQ(loop.score, 7.);
  }
}

TEST(PlaceMatcher, AnswersThatNameNothing) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.3, 4);
  EXPECT_THROW(RunWith(drives, [](const PlaceQuery&) { return PlaceAnswer{{{0, 9999}}}; }), Error);
  EXPECT_THROW(RunWith(drives, [](const PlaceQuery&) { return PlaceAnswer{{{-1, 0}}}; }), Error);
  EXPECT_THROW(RunWith(drives, [](const PlaceQuery&) { return PlaceAnswer{{}, 9999}; }), Error);
  EXPECT_TRUE(RunWith(drives, [](const PlaceQuery&) { return PlaceAnswer(); }).loops.empty())
      << "no place";
  PlaceAnswer nowhere;
  nowhere.accepted = true;
  EXPECT_THROW(RunWith(drives, [&](const PlaceQuery&) { return nowhere; }), Error);
}

}  // namespace
}  // namespace sslcd
