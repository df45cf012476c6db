// SPDX-License-Identifier: BSD-3-Clause
#include "refine/improvement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sslcd {
namespace {

TEST(ProbabilityNearer, IsThatOfTheErrorBeingLarger) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const double change : {0.5, 1., 2., 4.}) {
    constexpr int kDraws = 20000;
    int nearer = 0;
    for (int i = 0; i < kDraws; ++i) {
      const double error = normal(random);  // of the estimate; the start was at error - change
      nearer += std::abs(error) < std::abs(error - change) ? 1 : 0;
    }
    EXPECT_NEAR(ProbabilityNearer(change * change, change * change),
                static_cast<double>(nearer) / kDraws, 0.01);
  }
  EXPECT_EQ(ProbabilityNearer(0, 0), 0.5);
  EXPECT_EQ(ProbabilityNearer(0, 1), 0.5);
  EXPECT_EQ(ProbabilityNearer(1, 0), 1);
}

// A drive of 1 m a frame to the right of the axis `forward`, turning slowly, with one tree.
struct Walk {
  MapState state{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), {}};
  WholeMapOptions options;

  explicit Walk(const Pose& change) {
    for (int i = 0; i < 60; ++i) {
      FrameRecord record;
      record.frame = i;
      record.stamp = i;
      record.T_input_cam = record.T_odom_cam =
          Pose::Trans(0, -0.02 * i, i) * Pose::RotY(0.01 * i) * Pose::RotX(0.05);
      record.T_world_cam = change * record.T_input_cam;
      state.frames.Append(record);
    }
    MapLandmark tree;
    tree.label = "Tree";
    tree.symmetry = Symmetry::kFull;
    tree.state = LandmarkState::kConfirmed;
    tree.pose = {change * Vec3(2, 1, 30), 0};
    for (int i = 10; i < 25; ++i) {
      const Pose T_cam_tree =
          state.frames[i].T_world_cam.inverse() * ToPose(tree.pose, state.gravity());
      tree.sightings.push_back({i, double(i), 0, 1., T_cam_tree, Vec3(0.5, 0.5, 3)});
    }
    state.map.Insert(tree);
  }
  void Stretch(double factor) {
    for (int i = 0; i < state.frames.size(); ++i) {
      Pose pose = state.frames[i].T_world_cam;
      pose.translation() *= factor;
      state.frames.SetPose(i, pose);
    }
  }
  ImprovementProbability Judge() const { return ProbabilityOfImprovement(state, 0, {}, options); }
};

TEST(ProbabilityOfImprovement, IsEvenWhereOnlyTheFrameOfReferenceMoves) {
  const ImprovementProbability same = Walk(Pose()).Judge();
  EXPECT_EQ(same.horizontal, 0.5);
  EXPECT_EQ(same.height, 0.5);
  const ImprovementProbability moved = Walk(Pose::Trans(3, 1, 2) * Pose::RotY(0.4)).Judge();
  EXPECT_NEAR(moved.horizontal, 0.5, 1e-6);
  EXPECT_NEAR(moved.height, 0.5, 1e-6);
}

// The scale's standard deviation is that of its prior, half a per cent.
TEST(ProbabilityOfImprovement, GrowsWithTheChange) {
  double before = 0.5;
  for (const double stretch : {1.002, 1.01, 1.05, 1.3}) {
    Walk walk{Pose()};
    walk.Stretch(stretch);
    const double now = walk.Judge().horizontal;
    EXPECT_GT(now, before);
    before = now;
  }
  EXPECT_GT(before, 0.999) << "a third too long is no accident";
  Walk little{Pose()};
  little.Stretch(1.002);
  EXPECT_LT(little.Judge().horizontal, 0.9);
}

TEST(KeepOdometry, TakesOnePartOfEach) {
  const Pose change = Pose::Trans(3, 1, 2) * Pose::RotY(0.4) * Pose::RotX(0.1);
  const Walk optimised(change);
  for (const auto& [horizontal, height] : {std::pair(true, false), {false, true}, {true, true}}) {
    Walk walk(change);
    KeepOdometry({horizontal, height, {}}, walk.state, {});
    for (int i = 0; i < 60; ++i) {
      const Pose &odometry = optimised.state.frames[i].T_input_cam,
                 &other = optimised.state.frames[i].T_world_cam,
                 &now = walk.state.frames[i].T_world_cam;
      const Vec3 level = (horizontal ? odometry : other).translation();
      EXPECT_NEAR(now.translation().x(), level.x(), 1e-9);
      EXPECT_NEAR(now.translation().z(), level.z(), 1e-9);
      const Pose& steep = height ? odometry : other;
      EXPECT_NEAR(now.translation().y(), steep.translation().y(), 1e-9);
      const GravityFrame& gravity = walk.state.gravity();
      EXPECT_NEAR((now.so3().inverse() * gravity.up - steep.so3().inverse() * gravity.up).norm(), 0,
                  1e-9)
          << "tilt";
      if (horizontal && height) {
        EXPECT_NEAR((odometry.inverse() * now).Log().norm(), 0, 1e-9);
      }
    }
  }
}

TEST(KeepOdometry, ObjectsFollow) {
  Walk walk(Pose::Trans(3, 1, 2));
  KeepOdometry({true, true, {}}, walk.state, {});
  const Vec3 tree = walk.state.map.landmarks().begin()->second.pose.position;
  EXPECT_NEAR((tree - Vec3(2, 1, 30)).norm(), 0, 1e-6);
}

TEST(KeepOdometry, RaisesTheHeightsThatItKeeps) {
  Walk walk(Pose::Trans(3, 1, 2));
  KeptOdometry kept{false, true, std::vector<double>(60, 0.)};
  kept.rise_m[7] = 2;
  KeepOdometry(kept, walk.state, {});
  for (int i = 0; i < 60; ++i) {
    const FrameRecord& frame = walk.state.frames[i];
    const Vec3 raised = frame.T_world_cam.translation() - frame.T_input_cam.translation();
    EXPECT_NEAR(raised.dot(walk.state.gravity().up), i == 7 ? 2 : 0, 1e-9) << i;
  }
}

// The second half is a part of its own, whose odometry has another origin and heading.
FrameStore InTwoParts(const FrameStore& walk, const Pose& T_other_odom) {
  FrameStore frames;
  for (int i = 0; i < walk.size(); ++i) {
    FrameRecord record = walk[i];
    if (i >= 30) record.T_input_cam = record.T_odom_cam = T_other_odom * record.T_input_cam;
    frames.Append(record, StepUncertainty{i == 30});
  }
  return frames;
}

TEST(ProbabilityOfImprovement, IsEvenWhereOnlyAPartHasBeenPlaced) {
  Walk walk(Pose::Trans(3, 1, 2));
  walk.state.frames = InTwoParts(walk.state.frames, Pose::Trans(100, 0, 7) * Pose::RotY(2));
  EXPECT_NEAR(walk.Judge().horizontal, 0.5, 1e-3);
  EXPECT_NEAR(walk.Judge().height, 0.5, 1e-3);
}

TEST(KeepOdometry, PartsKeepTheirPlaces) {
  Walk walk(Pose::Trans(3, 1, 2));
  walk.state.frames = InTwoParts(walk.state.frames, Pose::Trans(100, 9, 7) * Pose::RotY(2));
  KeepOdometry({true, true, {}}, walk.state, {});
  for (const int i : {0, 29, 30, 59}) {
    const Pose T = Pose::Trans(0, -0.02 * i, i) * Pose::RotY(0.01 * i) * Pose::RotX(0.05);
    EXPECT_NEAR((T.inverse() * walk.state.frames[i].T_world_cam).Log().norm(), 0, 1e-9) << i;
  }
}

}  // namespace
}  // namespace sslcd
