// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/corrected_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sslcd {
namespace {

// The world's axes are forward, left, up.
const GravityFrame kGravity = GravityFrame::FromUp(Vec3::UnitZ());

// A drive of 1 m a frame along an arc of `turn` rad per metre; up is the camera's z.
std::vector<Pose> Arc(double turn, int frames) {
  std::vector<Pose> poses{Pose::Trans(Vec3(3, 2, 1))};
  const auto half = lie::SO3<double>::Exp(Vec3(0.5 * turn * Vec3::UnitZ()));
  for (int i = 1; i < frames; ++i)
    poses.push_back(poses.back() * Pose(half * half, half * Vec3(Vec3::UnitX())));
  return poses;
}

std::vector<Pose> Corrected(CorrectedOdometry& odometry, const std::vector<Pose>& poses) {
  std::vector<Pose> corrected;
  for (const Pose& pose : poses) corrected.push_back(odometry.Correct(pose));
  return corrected;
}

FrameStore Stored(const std::vector<Pose>& poses, int second_sequence) {
  FrameStore frames(0);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    FrameRecord record;
    record.frame = static_cast<int>(i);
    record.sequence = record.frame >= second_sequence ? 1 : 0;
    record.T_input_cam = record.T_odom_cam = record.T_world_cam = poses[i];
    frames.Append(record);
  }
  return frames;
}

TEST(CorrectedOdometry, WithoutATurnNothingChanges) {
  CorrectedOdometry odometry(kGravity, {});
  const std::vector<Pose> arc = Arc(0.02, 50), corrected = Corrected(odometry, arc);
  for (std::size_t i = 0; i < arc.size(); ++i)
    EXPECT_LT((arc[i].inverse() * corrected[i]).Log().norm(), 1e-9);
}

TEST(CorrectedOdometry, TurnsAnArcIntoAStraightLine) {
  CorrectedOdometry odometry(kGravity, {});
  FrameStore none(0);
  odometry.SetTurn(-0.02, none);
  const Vec3 end = Corrected(odometry, Arc(0.02, 101)).back().translation();
  EXPECT_NEAR((end - Vec3(103, 2, 1)).norm(), 0, 1e-6) << end.transpose();
}

TEST(CorrectedOdometry, FramesAreCorrectedAgainAsIfTheTurnHadBeenKnown) {
  std::vector<Pose> poses = Arc(0.02, 40);
  const std::vector<Pose> second = Arc(-0.01, 40);
  poses.insert(poses.end(), second.begin(), second.end());
  CorrectedOdometry learnt(kGravity, {}), known(kGravity, {});
  FrameStore frames = Stored(poses, 40), none(0);
  learnt.SetTurn(0.003, frames);
  known.SetTurn(0.003, none);
  for (int f = 0; f < frames.size(); ++f) {
    if (f == 40) known.StartSequence();
    const Pose& input = poses[static_cast<std::size_t>(f)];
    EXPECT_LT((known.Correct(input).inverse() * frames[f].T_odom_cam).Log().norm(), 1e-12) << f;
    EXPECT_LT((input.inverse() * frames[f].T_input_cam).Log().norm(), 1e-12) << f;
  }
  const Pose next = second.back() * Pose::Trans(Vec3(Vec3::UnitX()));
  EXPECT_LT((learnt.Correct(next).inverse() * known.Correct(next)).Log().norm(), 1e-12);
  learnt.SetTurn(0, frames);
  EXPECT_LT((frames[79].T_odom_cam.inverse() * poses[79]).Log().norm(), 1e-9);
}

TEST(CorrectedOdometry, AJumpIsNoPath) {
  CorrectedOdometry odometry(kGravity, {});
  FrameStore none(0);
  odometry.SetTurn(0.001, none);
  odometry.Correct(Pose());
  const Pose jumped = odometry.Correct(Pose::Trans(Vec3(1e5, 0, 0)));
  EXPECT_NEAR(jumped.so3().Log().norm(), 0.03, 1e-6) << "30 m of path";
}

}  // namespace
}  // namespace sslcd
