// SPDX-License-Identifier: BSD-3-Clause
// Odometry that reports that it was lost, or how uncertain it was.
#include <gtest/gtest.h>

#include <limits>

#include "loop_drives.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr int kLostFrames = 15;

// What the odometry does while it is lost.
enum class Lost { kStaysInPlace, kTurns, kRestartsAtTheOrigin };

// Twice round the block. On the second lap the odometry is lost for 12 m of the way.
Drives LostDrive(Lost what, std::uint64_t seed, bool reported = true) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, seed, world);
  Drive(path, 0, 2 * path.length() - 40, world);
  Drives drives(std::move(world), seed);
  std::vector<Frame>& frames = drives.frames;
  const std::size_t first = frames.size() / 2 + 40, after = first + kLostFrames;
  const std::vector<Frame> told = frames;
  const Pose in_place = what == Lost::kTurns ? Pose::RotY(100 * M_PI / 180) : Pose();
  for (std::size_t i = first; i < frames.size(); ++i) {
    const Pose step = told[i - 1].T_odom_cam.inverse() * told[i].T_odom_cam;
    frames[i].T_odom_cam = frames[i - 1].T_odom_cam * (i < after ? in_place : step);
    if (what == Lost::kRestartsAtTheOrigin && i + 1 == after) frames[i].T_odom_cam = Pose();
    if (reported && i < after) frames[i].step = StepUncertainty{true};
  }
  return drives;
}

class LostOdometry : public ::testing::TestWithParam<Lost> {};

TEST_P(LostOdometry, ClosesItsLoopsAfterwards) {
  for (const std::uint64_t seed : {1, 2}) {
    const Drives drives = LostDrive(GetParam(), seed);
    const RunResult result = drives.Run();
    const SequenceMetrics metrics = drives.Judge(result);
    EXPECT_GT(Accepted(result), 10) << "seed " << seed;
    EXPECT_EQ(metrics.wrong_loops, 0) << "seed " << seed;
    EXPECT_LT(metrics.ate, 1) << "seed " << seed;
    EXPECT_GT(metrics.ate_odometry, 4) << "seed " << seed;
    ExpectGoodRows(result);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, LostOdometry,
                         ::testing::Values(Lost::kStaysInPlace, Lost::kTurns,
                                           Lost::kRestartsAtTheOrigin));

TEST(ReportedOdometry, WithoutAnyRevisitALostStepStaysAsItWas) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, 1, world);
  Drive(path, 0, path.length() - 60, world);
  Drives drives(std::move(world), 1);
  for (const int lost : {120, 121, 122}) drives.frames[lost].step = StepUncertainty{true};
  const RunResult result = drives.Run();
  EXPECT_EQ(Accepted(result), 0);
  const SequenceMetrics metrics = drives.Judge(result);
  EXPECT_LT(metrics.ate, 1.1 * metrics.ate_odometry) << "each part is adjusted on its own";
}

TEST(ReportedOdometry, DetectionsOfALostFrameAreNotUsed) {
  const Drives drives = LostDrive(Lost::kStaysInPlace, 1);
  for (const MapObject& object : drives.Run().objects)
    for (const auto& [frame, row] : object.observations)
      EXPECT_FALSE(drives.frames[frame].step.has_value()) << frame;
}

TEST(ReportedOdometry, AStepThatIsNoNumberIsRefused) {
  const Drives drives = LostDrive(Lost::kStaysInPlace, 1);
  Mapper mapper({}, drives.Context());
  mapper.AddFrame(drives.frames[0]);
  Frame frame = drives.frames[1];
  for (const double bad :
       {-0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    frame.step = StepUncertainty{false, bad, 0};
    EXPECT_THROW(mapper.AddFrame(frame), Error);
    frame.step = StepUncertainty{false, 0, bad};
    EXPECT_THROW(mapper.AddFrame(frame), Error);
  }
  EXPECT_EQ(mapper.CameraTrajectory().size(), 1u);
  frame.step = StepUncertainty{false, 0.1, 0.01};
  EXPECT_NO_THROW(mapper.AddFrame(frame));
}

}  // namespace
}  // namespace sslcd
