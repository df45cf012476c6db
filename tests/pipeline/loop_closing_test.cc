// SPDX-License-Identifier: BSD-3-Clause
// Loop closure as a whole, on drives through small synthetic worlds whose truth is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "formats/g2o.h"
#include "formats/loops_csv.h"
#include "formats/map_json.h"
#include "loop_drives.h"
#include "sslcd/core/error.h"
#include "sslcd/formats/poses.h"

namespace sslcd {
namespace {

// (second lap, share of trees, seed)
class LoopClosing : public ::testing::TestWithParam<std::tuple<SecondLap, double, int>> {};

TEST_P(LoopClosing, CorrectsTheDriftOfTwoLaps) {
  const auto [second, share_of_trees, seed] = GetParam();
  const Drives drives = TwoLaps(second, share_of_trees, seed);
  const RunResult result = drives.Run();
  const SequenceMetrics metrics = drives.Judge(result);
  EXPECT_GT(metrics.loops, 10);
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_GT(metrics.recall, 0.7);
  EXPECT_LT(metrics.ate, 0.35 * metrics.ate_odometry);
  EXPECT_LE(metrics.landmarks_per_true, 1.08);
  EXPECT_GE(metrics.landmarks, metrics.true_landmarks - 2);
  EXPECT_GT(metrics.purity, 0.98);
  if (second == SecondLap::kOpposite) {
    EXPECT_GT(metrics.true_by_viewpoint.back(), 10);
  }
  EXPECT_EQ(Accepted(result), std::count_if(result.graph.edges.begin(), result.graph.edges.end(),
                                            [](const PoseGraph::Edge& edge) { return edge.loop; }));
  ExpectGoodRows(result);
}

INSTANTIATE_TEST_SUITE_P(
    CarsAndTrees, LoopClosing,
    ::testing::Combine(::testing::Values(SecondLap::kSame, SecondLap::kOpposite),
                       ::testing::Values(0.5, 1.), ::testing::Values(1, 2, 3)));

TEST(LoopClosingSwitch, OffMeansNone) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  Options options;
  options.loop.enabled = false;
  const RunResult result = drives.Run(options);
  EXPECT_TRUE(result.loops.empty());
  EXPECT_GT(drives.Judge(result).landmarks_per_true, 1.3)
      << "nothing has told that they are the same";
}

TEST(LoopClosingRepeats, ToTheByte) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 2);
  const auto bytes = [&] {
    const RunResult result = drives.Run();
    return TumText(result.trajectory) + MapJson({drives.world.gravity.up, result.objects}) +
           G2oText(result.graph) + LoopsCsv(result.loops);
  };
  EXPECT_EQ(bytes(), bytes());
}

TEST(LoopClosingRows, AreWrittenWithTheirReasons) {
  const RunResult result = TwoLaps(SecondLap::kSame, 0.5, 3).Run();
  const std::string csv = LoopsCsv(result.loops);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<long>(result.loops.size()) + 1);
  ASSERT_FALSE(result.loops.empty());
  for (const LoopClosure& loop : result.loops)
    EXPECT_NE(csv.find(loop.reason), std::string::npos) << loop.reason;
}

// The same with few objects: there is nothing to be sure of.
class FewObjects : public ::testing::TestWithParam<int> {};

TEST_P(FewObjects, CloseNothing) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  for (int i = 0; i < GetParam(); ++i)
    Add("Tree", path.ObjectAt(15 + 9 * i, i % 2 == 0 ? 5 : -6, 0.1, 0), world);
  Drive(path, 0, 2 * path.length(), world);
  const Drives drives(std::move(world), 1);
  const RunResult result = drives.Run();
  EXPECT_EQ(Accepted(result), 0);
  EXPECT_EQ(result.trajectory.size(), drives.frames.size());
  EXPECT_LT(drives.Judge(result).ate, 1.2 * drives.Judge(result).ate_odometry);
  ExpectGoodRows(result);
}

INSTANTIATE_TEST_SUITE_P(Counts, FewObjects, ::testing::Values(0, 1, 2, 3));

TEST(OddLayouts, AllOnALine) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const sim::Path path({{200, 0}});
    sim::World world = EmptyWorld();
    sim::Random random(seed);
    for (double s = 3; s < 230; s += random.Uniform(4, 14))
      Add("Tree", path.ObjectAt(s, 5, 0.1, 0), world);
    Drive(path, 0, 200, world);
    TurnRound(world);
    Drive(path, 200, 0, world);
    const Drives drives(std::move(world), seed);
    const RunResult result = drives.Run();
    const SequenceMetrics metrics = drives.Judge(result);
    EXPECT_EQ(metrics.wrong_loops, 0) << "seed " << seed;
    EXPECT_LT(metrics.ate, 1.2 * metrics.ate_odometry) << "seed " << seed;
    ExpectGoodRows(result);
  }
}

// The camera drives round it. Where odometry tells which car is which, loops may be closed, else
// not.
TEST(OddLayouts, TheSameCarThirtyTimesInAPerfectGrid) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  const sim::Path::Point start = path.At(0), opposite = path.At(0.5 * path.length());
  const Vec3 centre(0.5 * (start.x + opposite.x), 0.9, 0.5 * (start.z + opposite.z));
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 5; ++j)
      Add("Car", Pose(world.gravity.Upright(0), centre + Vec3(12 * (i - 2.5), 0, 14 * (j - 2.))),
          world);
  Drive(path, 0, 2 * path.length(), world);
  int ambiguous = 0;
  for (const double drift : {4e-3, 2e-2}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Drives drives(world, seed, 60, drift);
      const RunResult result = drives.Run();
      const SequenceMetrics metrics = drives.Judge(result);
      EXPECT_EQ(metrics.wrong_loops, 0) << "seed " << seed << ", drift " << drift;
      EXPECT_LT(metrics.ate, 1.1 * metrics.ate_odometry) << "seed " << seed << ", drift " << drift;
      ambiguous += Count(result, LoopDecision::kAmbiguous);
      ExpectGoodRows(result);
    }
  }
  EXPECT_GT(ambiguous, 0);
}

TEST(OddLayouts, ARowThatLooksTheSameEverywhere) {
  const sim::Path path({{400, 0}});
  sim::World world = EmptyWorld();
  for (int i = 0; i < 70; ++i)
    for (const double right : {4., -6.}) Add("Car", path.ObjectAt(3 + 6 * i, right, 0.9, 0), world);
  Drive(path, 0, 400, world);
  const Drives drives(std::move(world), 1);
  const RunResult result = drives.Run();
  EXPECT_EQ(Accepted(result), 0);
  ExpectGoodRows(result);
}

TEST(OddLayouts, NewGroundClosesNothing) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const sim::Path path({{150, 0}, {60, 0.02}, {150, 0}, {60, -0.02}, {200, 0}});
    sim::World world = EmptyWorld();
    Plant(path, 620, 0.5, seed, world);
    Drive(path, 0, 600, world);
    const Drives drives(std::move(world), seed);
    const RunResult result = drives.Run();
    EXPECT_EQ(Accepted(result), 0) << "seed " << seed;
    ExpectGoodRows(result);
  }
}

TEST(OddLayouts, ALoopToTheFirstKeyframe) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, 2, world);
  Drive(path, 0, path.length() + 12, world);
  const Drives drives(std::move(world), 2);
  const RunResult result = drives.Run();
  EXPECT_TRUE(std::any_of(result.loops.begin(), result.loops.end(), [](const LoopClosure& loop) {
    return loop.decision == LoopDecision::kAccepted && loop.match_frame == 0;
  }));
  const SequenceMetrics metrics = drives.Judge(result);
  EXPECT_EQ(metrics.wrong_loops, 0);
  EXPECT_LT(metrics.ate, 0.35 * metrics.ate_odometry);
  EXPECT_NEAR((result.trajectory.poses[0].inverse() * result.odometry.poses[0]).Log().norm(), 0,
              1e-6)
      << "the first camera stays where the odometry has it";
}

TEST(LoopClosingMapper, RefusesBadPosesMidRunAndGoesOn) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  Mapper disturbed({}, drives.Context()), mapper({}, drives.Context());
  for (std::size_t i = 0; i < drives.frames.size(); ++i) {
    if (i % 100 == 50) {
      for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        Frame frame = drives.frames[i];
        frame.T_odom_cam.translation().z() = bad;
        EXPECT_THROW(disturbed.AddFrame(frame), Error);
        frame = drives.frames[i];
        frame.T_odom_cam.data()[0] = bad;  // of the quaternion
        EXPECT_THROW(disturbed.AddFrame(frame), Error);
      }
    }
    disturbed.AddFrame(drives.frames[i]);
    mapper.AddFrame(drives.frames[i]);
  }
  disturbed.Refine();
  mapper.Refine();
  EXPECT_EQ(TumText(disturbed.CameraTrajectory()), TumText(mapper.CameraTrajectory()));
  EXPECT_EQ(LoopsCsv(disturbed.LoopClosures()), LoopsCsv(mapper.LoopClosures()));
  EXPECT_GT(mapper.LoopClosures().size(), 10u);
}

// On the whole: a single trajectory, which is bent in one way here and in another there, may be a
// little worse for it.
TEST(LoopClosingMapper, HasTheMapAdjustedBeforeAnythingIsRefined) {
  double sum_with = 0, sum_without = 0;
  for (const int seed : {1, 2, 3}) {
    const Drives drives = TwoLaps(SecondLap::kSame, 0.5, seed);
    std::vector<Pose> odometry;
    for (const Frame& frame : drives.frames) odometry.push_back(frame.T_odom_cam);
    const auto run = [&](int adjust_keyframes) {
      Options options;
      options.loop.adjust_keyframes = adjust_keyframes;
      Mapper mapper(options, drives.Context());
      for (const Frame& frame : drives.frames) mapper.AddFrame(frame);
      return ComputeSequenceMetrics({mapper.CameraTrajectory().poses, odometry,
                                     drives.world.truth.poses, drives.frames, drives.identities,
                                     mapper.LoopClosures(), mapper.Objects()});
    };
    const SequenceMetrics with = run(500), without = run(0), too_long = run(10);
    sum_with += with.ate;
    sum_without += without.ate;
    EXPECT_LT(with.ate, 0.35 * with.ate_odometry) << "seed " << seed;
    EXPECT_EQ(with.wrong_loops, 0) << "seed " << seed;
    EXPECT_EQ(too_long.ate, without.ate) << "a run of more keyframes than that goes without";
  }
  EXPECT_LT(sum_with, sum_without);
}

}  // namespace
}  // namespace sslcd
