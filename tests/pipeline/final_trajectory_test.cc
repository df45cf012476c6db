// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/final_trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "loop_drives.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {
namespace {

Drives WithPerfectOdometry() {
  Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  for (std::size_t i = 0; i < drives.frames.size(); ++i)
    drives.frames[i].T_odom_cam = drives.world.truth.poses[i];
  return drives;
}

double LargestChange(const Trajectory& a, const Trajectory& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    largest = std::max(largest, (a.poses[i].inverse() * b.poses[i]).Log().norm());
  return largest;
}

TEST(FinalTrajectory, IsAPerfectOdometryAsItWasGiven) {
  const Drives drives = WithPerfectOdometry();
  const RunResult result = drives.Run();
  EXPECT_GT(Accepted(result), 10);
  EXPECT_LT(LargestChange(result.trajectory, result.odometry), 1e-9);
  EXPECT_EQ(result.scale, 1);
  Options always;
  always.refine.least_probability = 0;
  const RunResult optimised = drives.Run(always);
  EXPECT_GT(LargestChange(optimised.trajectory, result.odometry), 1e-3);
  EXPECT_GT(result.improvement.horizontal, 0);
  EXPECT_EQ(optimised.improvement.horizontal, 0) << "nobody asks";
}

// Between sequences there is no odometry to keep.
TEST(FinalTrajectory, IsTheMoreProbableOneWhereLoopsJoinSequences) {
  const std::vector<sim::PathPiece> side{{25, 0}, {4 * M_PI, 1. / 8}};
  const sim::Path path({side[0], side[1], side[0], side[1], side[0], side[1], side[0], side[1]},
                       true);
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, 1, world);
  Drive(path, 0, path.length() + 90, world);
  Drives drives(std::move(world), 1);
  for (std::size_t i = 0; i < drives.frames.size(); ++i)
    drives.frames[i].T_odom_cam = drives.world.truth.poses[i];
  const std::size_t cut = drives.frames.size() / 2;
  drives.frames[cut].step = StepUncertainty{true};
  const RunResult result = drives.Run();
  EXPECT_GT(result.improvement.horizontal, 0.5);
  EXPECT_LT(result.improvement.horizontal, Options().refine.least_probability);
  const auto way = [&](const Trajectory& trajectory) {  // of the first sequence, level
    const Vec3 moved = (trajectory.poses[0].inverse() * trajectory.poses[cut - 1]).translation();
    return std::hypot(moved.x(), moved.z());
  };
  EXPECT_GT(std::abs(way(result.trajectory) - way(result.odometry)), 1e-3) << "it is optimised";
}

TEST(FinalTrajectory, IsTheOptimisedOneWhereOdometryDrifts) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  const RunResult result = drives.Run();
  EXPECT_GT(result.improvement.horizontal, 0.999);
  const SequenceMetrics metrics = drives.Judge(result);
  EXPECT_LT(metrics.ate, 0.3 * metrics.ate_odometry);
}

// A camera on a slope of the odometry's world that the odometry reports may have drifted there; one
// that never tilts keeps its heights.
TEST(FinalTrajectory, HasTheHeightsOfALevelOdometry) {
  Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  const RunResult level = drives.Run();
  double largest = 0;
  for (std::size_t i = 0; i < level.trajectory.poses.size(); ++i)
    largest = std::max(largest, std::abs(level.trajectory.poses[i].translation().y() -
                                         level.odometry.poses[i].translation().y()));
  EXPECT_LT(level.improvement.height, 0.975) << "the world is flat";
  EXPECT_LT(largest, 1e-9);
}

TEST(FinalTrajectory, IsTheOdometryInAWorldThatIsTurned) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  MapperContext context = drives.Context();
  context.gravity = GravityFrame::FromUp({0, 0, 1});
  const RunResult result = RunSequence(drives.frames, context, {});
  EXPECT_LT(LargestChange(result.trajectory, result.odometry), 1e-9);
  EXPECT_EQ(result.improvement.horizontal, 0);
}

TEST(FinalTrajectory, IsWhatTheNextFrameContinues) {
  const Drives drives = WithPerfectOdometry();
  Mapper mapper({}, drives.Context());
  Trajectory odometry;
  for (const Frame& frame : drives.frames) {
    if (&frame == &drives.frames.back()) {
      mapper.Refine(Refinement::kOnTheWay);
      EXPECT_LT(LargestChange(mapper.CameraTrajectory(), odometry), 1e-9);
      EXPECT_GT(mapper.Objects().size(), 20u);
    }
    mapper.AddFrame(frame);
    odometry.poses.push_back(frame.T_odom_cam);
  }
  EXPECT_LT(LargestChange(mapper.CameraTrajectory(), odometry), 0.02) << "of the last step alone";
  EXPECT_EQ(mapper.improvement().horizontal, 0) << "of no refinement any more";
}

}  // namespace
}  // namespace sslcd
