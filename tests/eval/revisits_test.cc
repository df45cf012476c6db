// SPDX-License-Identifier: BSD-3-Clause
#include "eval/revisits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "eval/path.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

/// Out along z for 100 m and straight back 3 m beside it, a metre a frame, looking ahead. A tree at
/// every third metre of the first 60 is seen from next to it, both times.
struct OutAndBack {
  std::vector<Pose> reference;
  std::vector<Frame> frames;
  std::vector<int> identities;

  OutAndBack() {
    for (int f = 0; f <= 200; ++f) {
      const bool back = f > 100;
      const int z = back ? 200 - f : f;
      reference.push_back(
          Pose(lie::SO3<double>::RotY(back ? M_PI : 0.), Vec3(back ? 3. : 0., 0, z)));
      Frame frame;
      frame.index = f;
      if (z < 60 && z % 3 == 0) {
        Detection detection;
        detection.row = static_cast<int>(identities.size());
        frame.detections.push_back(detection);
        identities.push_back(z / 3);
      }
      frames.push_back(frame);
    }
  }
  LoopClosure Loop(int query, int match, double off_m, double score) const {
    LoopClosure loop;
    loop.query_frame = query;
    loop.match_frame = match;
    loop.decision = LoopDecision::kAccepted;
    loop.score = score;
    loop.T_match_query = reference[match].inverse() * reference[query] * Pose::Trans(off_m, 0, 0);
    return loop;
  }
};

TEST(Revisits, WhereTheCameraHasBeenAndKnowsEnough) {
  const OutAndBack drive;
  const std::vector<Revisit> revisits =
      FindRevisits(drive.reference, drive.frames, drive.identities);
  ASSERT_FALSE(revisits.empty());
  // Old cameras are near from z = 69 on, 60 m of path and the turn before; five trees within 20 m
  // from z = 65 on.
  EXPECT_NEAR(200 - revisits.front().frame, 65, 5);
  EXPECT_GE(revisits.back().frame, 195);
  for (const Revisit& revisit : revisits) {
    EXPECT_NEAR(revisit.viewpoint_rad, M_PI, 1e-9);
    EXPECT_EQ(revisit.old_frame, 200 - revisit.frame);
    EXPECT_NEAR(revisit.distance_m, 3, 1e-9);
    EXPECT_GE(revisit.common, 5);
  }
  for (std::size_t i = 1; i < revisits.size(); ++i)
    EXPECT_NEAR(revisits[i].at_m - revisits[i - 1].at_m, 5, 1e-9);

  RevisitOptions nearer;
  nearer.radius_m = 2.9;
  EXPECT_TRUE(FindRevisits(drive.reference, drive.frames, drive.identities, nearer).empty());
  RevisitOptions more;
  more.common = 20;
  EXPECT_TRUE(FindRevisits(drive.reference, drive.frames, drive.identities, more).empty());
  EXPECT_TRUE(FindRevisits({}, {}, {}).empty());
}

TEST(Revisits, TheNearestOldCameraIsThatOfASearchThroughAll) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> turn(-.2, .2), step(0, 2);
  std::vector<Pose> reference{Pose()};
  for (double heading = 0; reference.size() < 3000; heading += .03 + turn(random))
    reference.push_back(Pose(lie::SO3<double>::RotY(heading),
                             reference.back().translation() +
                                 step(random) * Vec3(std::sin(heading), .1, std::cos(heading))));
  RevisitOptions options;
  options.common = 0;
  const std::vector<Revisit> revisits = FindRevisits(reference, {}, {}, options);
  EXPECT_GT(revisits.size(), 20u);
  const std::vector<double> path_m = DistanceAlong(reference);
  double next_m = 0;
  std::size_t found = 0;
  for (int f = 0; f < 3000; ++f) {
    if (path_m[f] < next_m) continue;
    next_m = path_m[f] + options.spacing_m;
    std::pair<double, int> nearest{options.radius_m, -1};
    for (int old = 0; old < f && path_m[old] < path_m[f] - options.old_m; ++old) {
      const Vec3 apart = reference[old].translation() - reference[f].translation();
      const double m = std::hypot(apart.x(), apart.z());
      if (m < nearest.first) nearest = {m, old};
    }
    if (nearest.second < 0) continue;
    ASSERT_LT(found, revisits.size());
    EXPECT_EQ(revisits[found].frame, f);
    EXPECT_EQ(revisits[found].old_frame, nearest.second);
    EXPECT_EQ(revisits[found++].distance_m, nearest.first);
  }
  EXPECT_EQ(found, revisits.size());
}

TEST(Revisits, FalseAlarmsAreNobody) {
  OutAndBack drive;
  for (int& identity : drive.identities) identity = -1;
  EXPECT_TRUE(FindRevisits(drive.reference, drive.frames, drive.identities).empty());
  drive.identities.pop_back();
  EXPECT_THROW(FindRevisits(drive.reference, drive.frames, drive.identities), Error);
}

TEST(Revisits, OutcomeOfALoop) {
  const OutAndBack drive;
  const std::vector<LoopOutcome> loops =
      MeasureLoopErrors({drive.Loop(190, 12, 0.5, 7)}, drive.reference);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_TRUE(loops[0].accepted);
  EXPECT_EQ(loops[0].score, 7);
  EXPECT_NEAR(loops[0].error_m, 0.5, 1e-9);
  EXPECT_NEAR(loops[0].error_rad, 0, 1e-9);
  EXPECT_NEAR(loops[0].viewpoint_rad, M_PI, 1e-9);
  LoopClosure outside = drive.Loop(190, 12, 0, 0);
  outside.query_frame = 999;
  EXPECT_THROW(MeasureLoopErrors({outside}, drive.reference), Error);
}

TEST(Revisits, RightAnswersOnceAndWrongOnesEachTime) {
  const OutAndBack drive;
  const std::vector<Revisit> all = FindRevisits(drive.reference, drive.frames, drive.identities);
  const std::vector<Revisit> two = {all[1], all[8]};  // 35 m apart
  const auto near = [&](int i, int shift) { return two[i].frame + shift; };
  const auto old = [&](int i) { return two[i].old_frame; };
  const std::vector<LoopOutcome> loops = MeasureLoopErrors(
      {drive.Loop(near(0, 0), old(0), 0, 3),
       drive.Loop(near(0, 2), old(0), 1, 4),  // one place, right twice
       drive.Loop(near(1, 0), old(1), 6, 9), drive.Loop(near(1, 1), old(1), 7, 8),  // wrong twice
       drive.Loop(near(0, 20), old(0), 0, 5)},  // right, but not asked for
      drive.reference);
  std::vector<ScoredAnswer> answers = AnswersOf(two, loops, 5.);
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_TRUE(answers[0].correct);
  EXPECT_EQ(answers[0].score, 4) << "the surest one";
  EXPECT_FALSE(answers[1].correct);
  EXPECT_FALSE(answers[2].correct);
  EXPECT_EQ(AnswersOf(two, loops, 10.).size(), 2u) << "6 and 7 m are right now";
  EXPECT_TRUE(AnswersOf(two, {}, 5.).empty());
}

}  // namespace
}  // namespace sslcd
