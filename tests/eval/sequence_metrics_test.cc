// SPDX-License-Identifier: BSD-3-Clause
#include "eval/sequence_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

/// Out along z for 100 m and straight back, a metre a frame, looking where it goes. Ten trees stand
/// at the first 30 m and are seen from next to them, both times: identity k at 3 k metres.
SequenceRun OutAndBack() {
  SequenceRun run;
  for (int f = 0; f <= 200; ++f) {
    const bool back = f > 100;
    run.reference.push_back(
        Pose(lie::SO3<double>::RotY(back ? M_PI : 0.), Vec3(0.02 * f, 0, back ? 200 - f : f)));
    Frame frame;
    frame.index = f;
    const int z = back ? 200 - f : f;
    if (z < 30 && z % 3 == 0) {
      Detection detection;
      detection.row = static_cast<int>(run.identities.size());
      frame.detections.push_back(detection);
      run.identities.push_back(z / 3);
    }
    run.frames.push_back(frame);
  }
  run.estimate = run.odometry = run.reference;
  return run;
}

LoopClosure Accepted(int query, int match, const Pose& T_match_query) {
  LoopClosure loop;
  loop.query_frame = query;
  loop.match_frame = match;
  loop.decision = LoopDecision::kAccepted;
  loop.T_match_query = T_match_query;
  return loop;
}

LoopClosure LoopWithError(const SequenceRun& run, int query, int match, const Pose& error) {
  return Accepted(query, match, run.reference[match].inverse() * run.reference[query] * error);
}

TEST(SequenceMetricsTest, LoopsByErrorAndViewpoint) {
  SequenceRun run = OutAndBack();
  run.loops = {
      LoopWithError(run, 195, 5, Pose()), LoopWithError(run, 196, 4, Pose::Trans(4.9, -1.4, 0)),
      LoopWithError(run, 197, 3, Pose::Trans(3.6, 0, 3.6)),
      LoopWithError(run, 198, 2, Pose::RotX(0.1)), LoopWithError(run, 60, 40, Pose::RotZ(0.05))};
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_EQ(metrics.loops, 5);
  EXPECT_EQ(metrics.wrong_loops, 2);  // 5.1 m, and 5.7 degrees
  EXPECT_EQ(metrics.wrong_in_height, 0);
  EXPECT_EQ(metrics.true_by_viewpoint, (std::array<int, 4>{1, 0, 0, 2}));
  EXPECT_NEAR(metrics.loop_error_median_m.value(), 0, 1e-9);
  EXPECT_NEAR(metrics.loop_error_median_rad.value(), 0, 1e-9);
  EXPECT_NEAR(metrics.ate, 0, 1e-9);
  EXPECT_NEAR(metrics.path, 200, 0.1);
}

TEST(SequenceMetricsTest, ALoopOnAnotherStoreyIsWrong) {
  SequenceRun run = OutAndBack();
  run.loops = {LoopWithError(run, 195, 5, Pose::Trans(0, 1.49, 0)),
               LoopWithError(run, 196, 4, Pose::Trans(0, 1.51, 0)),
               LoopWithError(run, 197, 3, Pose::Trans(0, -3, 0))};
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_EQ(metrics.wrong_loops, 2);
  EXPECT_EQ(metrics.wrong_in_height, 2);
}

TEST(SequenceMetricsTest, RefusedLoopsDoNotCount) {
  SequenceRun run = OutAndBack();
  for (const LoopDecision decision : {LoopDecision::kNone, LoopDecision::kAmbiguous}) {
    run.loops.push_back(LoopWithError(run, 195, 5, Pose()));
    run.loops.back().decision = decision;
  }
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_EQ(metrics.loops, 0);
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_EQ(metrics.recall, 0);
}

TEST(SequenceMetricsTest, RevisitedStretches) {
  SequenceRun run = OutAndBack();
  // Five trees have come back into the last 40 m at 185 m, where the path ends at 200.04 m: marks
  // at 190 and 200.
  SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_EQ(metrics.revisited_stretches, 2);
  EXPECT_EQ(metrics.recall, 0);
  EXPECT_FALSE(metrics.loop_error_median_m.has_value());
  run.loops = {LoopWithError(run, 185, 15, Pose())};
  EXPECT_EQ(ComputeSequenceMetrics(run).recall, 0.5);
  run.loops = {LoopWithError(run, 195, 5, Pose())};
  EXPECT_EQ(ComputeSequenceMetrics(run).recall, 1);
  run.loops = {LoopWithError(run, 195, 5, Pose::Trans(9, 0, 0))};
  EXPECT_EQ(ComputeSequenceMetrics(run).recall, 0);
  for (int& identity : run.identities) identity = -1;
  metrics = ComputeSequenceMetrics(run);
  EXPECT_EQ(metrics.revisited_stretches, 0);
  EXPECT_EQ(metrics.true_landmarks, 0);
}

TEST(SequenceMetricsTest, APathWithAPoseFarOffHasAnEnd) {
  for (const double far_m : {1e9, 1e17, 1e300}) {
    SequenceRun run = OutAndBack();
    run.reference[100].translation().x() = far_m;
    EXPECT_LE(ComputeSequenceMetrics(run).revisited_stretches, 3) << far_m;
  }
}

TEST(SequenceMetricsTest, MapAgainstIdentities) {
  SequenceRun run = OutAndBack();
  MapObject a, b, c, tentative;
  a.state = b.state = c.state = LandmarkState::kConfirmed;
  a.observations = {{0, 0}, {3, 1}, {200, 19}};  // rows 0 and 19 are tree 0, row 1 is tree 1
  b.observations = {{200, 19}};
  run.identities.push_back(-1);
  c.observations = {{3, 20}};  // a false alarm
  run.objects = {a, b, c, tentative};
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_EQ(metrics.landmarks, 3);
  EXPECT_EQ(metrics.true_landmarks, 10);
  EXPECT_EQ(metrics.landmarks_per_true, 2);
  EXPECT_DOUBLE_EQ(metrics.purity, 0.75);
}

TEST(SequenceMetricsTest, ListsOfDifferentLengthAreCut) {
  SequenceRun run = OutAndBack();
  run.estimate.resize(150);
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_NEAR(metrics.path, 149, 0.1);
  EXPECT_EQ(metrics.revisited_stretches, 0);
}

TEST(SequenceMetricsTest, OutOfRange) {
  SequenceRun run = OutAndBack();
  run.loops = {Accepted(201, 0, Pose())};
  EXPECT_THROW(ComputeSequenceMetrics(run), Error);
  run.loops = {Accepted(5, -1, Pose())};
  EXPECT_THROW(ComputeSequenceMetrics(run), Error);
  run.loops.clear();
  run.identities.pop_back();
  EXPECT_THROW(ComputeSequenceMetrics(run), Error);
  EXPECT_THROW(ComputeSequenceMetrics({}), Error);
}

TEST(SequenceMetricsTest, OneFrame) {
  SequenceRun run;
  run.reference = run.estimate = run.odometry = {Pose()};
  const SequenceMetrics metrics = ComputeSequenceMetrics(run);
  EXPECT_EQ(metrics.path, 0);
  EXPECT_EQ(metrics.ate, 0);
  EXPECT_EQ(metrics.recall, 0);
}

}  // namespace
}  // namespace sslcd
