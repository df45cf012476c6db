// SPDX-License-Identifier: BSD-3-Clause
// Loop closure where loops meet, contradict one another, or are closed as printed.
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "core/median.h"
#include "loop_drives.h"
#include "sim/halv.h"

namespace sslcd {
namespace {

// In the third lap every place has been passed twice.
TEST(LoopCases, TwoLoopsAtOnce) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, 4, world);
  Drive(path, 0, 3 * path.length(), world);
  const Drives drives(std::move(world), 4);
  const RunResult result = drives.Run();
  const SequenceMetrics metrics = drives.Judge(result);
  const int lap = static_cast<int>(path.length() / kStep);
  const auto in_third =
      std::count_if(result.loops.begin(), result.loops.end(), [lap](const LoopClosure& loop) {
        return loop.decision == LoopDecision::kAccepted && loop.query_frame > 2 * lap;
      });
  EXPECT_GT(in_third, 20);
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_LT(metrics.ate, 0.35 * metrics.ate_odometry);
  EXPECT_LE(metrics.landmarks_per_true, 1.08) << "three passes are one landmark";
  ExpectGoodRows(result);
}

// The second half of the block is furnished exactly like the first, which nobody can know on the
// first lap.
TEST(LoopCases, LoopsToACopyOfAPlaceAreRefused) {
  int refused = 0;
  for (const double drift : {4e-3, 1e-2}) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const sim::Path path = Block();
      sim::World world = EmptyWorld();
      const double half = 0.5 * path.length();
      Plant(path, half, 0.5, seed, world);
      const Pose T_original_copy = path.CameraAt(half) * path.CameraAt(0).inverse();
      for (std::size_t i = 0, originals = world.objects.size(); i < originals; ++i)
        Add(world.objects[i].label, T_original_copy * world.objects[i].T_world_object[0], world);
      Drive(path, 0, 2 * path.length(), world);
      const Drives drives(std::move(world), seed, 30, drift);
      const RunResult result = drives.Run();
      const SequenceMetrics metrics = drives.Judge(result);
      EXPECT_EQ(metrics.wrong_loops, 0) << "seed " << seed << ", drift " << drift;
      EXPECT_LT(metrics.ate, metrics.ate_odometry) << "seed " << seed << ", drift " << drift;
      EXPECT_GT(metrics.loops, 0) << "seed " << seed << ", drift " << drift;
      refused += Count(result, LoopDecision::kAmbiguous);
      ExpectGoodRows(result);
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(LoopCases, WithHindsightLessIsEnough) {
  Options as_it_came;
  as_it_came.refine.enabled = false;  // no end, no second look
  double first = 0, second = 0;
  for (const int seed : {1, 4}) {
    sim::HalvOptions curve;
    curve.scene.case_number = 3;
    const sim::HalvSequence halv = sim::MakeHalv(seed, curve);
    const sim::World& world = halv.scene.world;
    const std::vector<Frame> frames = sim::MakeFrames(halv.odometry, halv.detections);
    const auto run = [&](const Options& options, double& recall) {
      RunResult result = RunSequence(frames, {world.gravity, world.labels, world.camera}, options);
      const SequenceMetrics metrics =
          ComputeSequenceMetrics({result.trajectory.poses, result.odometry.poses, world.truth.poses,
                                  frames, halv.detections.identity, result.loops, result.objects});
      EXPECT_EQ(metrics.wrong_loops, 0);
      recall += metrics.recall / 2;
      return result.loops;
    };
    const std::vector<LoopClosure> before = run(as_it_came, first), after = run({}, second);
    ASSERT_GT(after.size(), before.size());
    for (std::size_t i = before.size(); i < after.size(); ++i)
      EXPECT_EQ(after[i].newest_frame, frames.back().index) << "known at the end only";
  }
  EXPECT_GT(second, first + 0.1);
}

TEST(LoopCases, LoopsGoOnAfterARefinementInMidRun) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  Mapper mapper({}, drives.Context());
  const std::size_t middle = drives.frames.size() * 7 / 10;
  std::size_t before = 0;
  for (std::size_t i = 0; i < drives.frames.size(); ++i) {
    mapper.AddFrame(drives.frames[i]);
    if (i != middle) continue;
    mapper.Refine();
    before = mapper.LoopClosures().size();
  }
  mapper.Refine();
  const auto loops = mapper.LoopClosures();
  EXPECT_GT(before, 3u);
  EXPECT_GT(std::count_if(
                loops.begin() + static_cast<std::ptrdiff_t>(before), loops.end(),
                [](const LoopClosure& loop) { return loop.decision == LoopDecision::kAccepted; }),
            3);
  RunResult result;
  result.trajectory = mapper.CameraTrajectory();
  result.odometry = drives.Run().odometry;
  result.loops = loops;
  result.objects = mapper.Objects();
  const SequenceMetrics metrics = drives.Judge(result);
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_LT(metrics.ate, 0.35 * metrics.ate_odometry);
}

// Loops are measured again in the corrected maps, between the same cameras.
TEST(LoopCases, RefinementMeasuresThemAnew) {
  std::vector<double> before, after;  // errors [m]
  for (const int seed : {1, 2, 3}) {
    const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, seed);
    Mapper mapper({}, drives.Context());
    for (const Frame& frame : drives.frames) mapper.AddFrame(frame);
    const std::vector<LoopClosure> found = WithoutEarly(mapper.LoopClosures());
    mapper.Refine();
    const std::vector<LoopClosure> refined = mapper.LoopClosures();
    const auto error = [&](const LoopClosure& loop) {
      const auto& truth = drives.world.truth.poses;
      const Pose T_match_query = truth[loop.match_frame].inverse() * truth[loop.query_frame];
      return (T_match_query.inverse() * loop.T_match_query).translation().norm();
    };
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].query_frame, refined[i].query_frame);
      EXPECT_EQ(found[i].match_frame, refined[i].match_frame);
      if (found[i].decision != LoopDecision::kAccepted ||
          refined[i].decision != LoopDecision::kAccepted)
        continue;
      before.push_back(error(found[i]));
      after.push_back(error(refined[i]));
    }
  }
  ASSERT_GT(before.size(), 50u);
  EXPECT_LT(Median(after), 0.9 * Median(before)) << before.size();
}

// A better trajectory may show more loops, but none twice.
TEST(LoopCases, RefiningAgainRepeatsNoLoop) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Mapper mapper({}, drives.Context());
  for (const Frame& frame : drives.frames) mapper.AddFrame(frame);
  std::size_t first = 0;
  for (int i = 0; i < 3; ++i) {
    mapper.Refine();
    if (i == 0) first = mapper.LoopClosures().size();
    std::set<std::tuple<int, int, int>> cameras;
    for (const LoopClosure& loop : mapper.LoopClosures())
      cameras.insert({loop.newest_frame, loop.query_frame, loop.match_frame});
    EXPECT_EQ(cameras.size(), mapper.LoopClosures().size());
    EXPECT_LE(mapper.LoopClosures().size(), first + 3);
  }
  EXPECT_GT(first, 50u);
}

// mode: paper believes every match; what comes of it is for comparison, but it has to be written
// down in full.
TEST(LoopCases, AsPrinted) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  const RunResult result = drives.Run(DefaultOptions(Mode::kPaper));
  EXPECT_GT(result.loops.size(), 10u);
  EXPECT_EQ(result.trajectory.size(), drives.frames.size());
  EXPECT_EQ(Accepted(result), static_cast<int>(result.loops.size())) << "it knows no refusal";
  ExpectGoodRows(result);
}

}  // namespace
}  // namespace sslcd
