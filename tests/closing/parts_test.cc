// SPDX-License-Identifier: BSD-3-Clause
#include "closing/parts.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

// Four parts of ten frames, 1 m apart, each 100 m beside the one before and turned.
MapState FourParts() {
  MapState state{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), FrameStore(100)};
  for (int i = 0; i < 40; ++i) {
    const int part = i / 10;
    FrameRecord record;
    record.frame = i;
    record.stamp = i;
    record.T_odom_cam = Pose::Trans(0, 0, i % 10);
    record.T_world_cam =
        Pose::Trans(100 * part, 3 * part, 0) * Pose::RotY(0.5 * part) * record.T_odom_cam;
    state.frames.Append(record, StepUncertainty{i > 0 && i % 10 == 0});
  }
  return state;
}

LoopClosure At(const Pose& T_match_query) {
  LoopClosure closure;
  closure.T_match_query = T_match_query;
  return closure;
}

double Difference(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

TEST(JoinParts, OverOthersByTheEarliest) {
  const FrameStore frames = FourParts().frames;
  EXPECT_TRUE(JoinParts({}, {}).empty());
  EXPECT_EQ(JoinParts(frames, {}), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(JoinParts(frames, {{3, 7}}), (std::vector<int>{0, 1, 2, 3})) << "within one";
  EXPECT_EQ(JoinParts(frames, {{15, 35}, {25, 36}}), (std::vector<int>{0, 1, 1, 1}));
  EXPECT_EQ(JoinParts(frames, {{15, 35}, {38, 2}}), (std::vector<int>{0, 0, 2, 0}))
      << "whichever the query is of";
}

TEST(PlaceParts, TheLaterOneGoesWhereTheLoopSays) {
  for (const bool reversed : {false, true}) {
    MapState state = FourParts();
    MapLandmark tree;
    tree.label = "Tree";
    tree.pose = {state.frames[22].T_world_cam * Vec3(1, 0, 5), 0};
    tree.sightings.push_back({22, 22., 0, 1., Pose::Trans(1, 0, 5), Vec3(1, 1, 3)});
    const LandmarkId id = state.map.Insert(tree);
    const Pose T_match_query = Pose::Trans(2, 1, 3) * Pose::RotY(2);
    const LoopClosure closure = At(reversed ? T_match_query.inverse() : T_match_query);
    const LoopEdge loop = reversed ? LoopEdge{22, 4, &closure} : LoopEdge{4, 22, &closure};
    const LoopClosure other = At({});
    const std::vector<Pose> before = PosesOf(state.frames);
    PlaceParts(state, {{25, 35, &other}}, {loop}, {});
    const std::vector<Pose> now = PosesOf(state.frames);
    EXPECT_NEAR(Difference(now[4] * T_match_query, now[22]), 0, 1e-9);
    EXPECT_NEAR(Difference(before[22].inverse() * before[38], now[22].inverse() * now[38]), 0, 1e-9)
        << "with all that is joined to it";
    for (const int f : {0, 9, 10, 19}) EXPECT_NEAR(Difference(before[f], now[f]), 0, 1e-12);
    EXPECT_NEAR((now[22] * Vec3(1, 0, 5) - state.map.at(id).pose.position).norm(), 0, 1e-9);
  }
}

TEST(PlaceParts, StayUpright) {
  MapState state = FourParts();
  const LoopClosure closure = At(Pose::RotX(0.1) * Pose::RotY(1));
  PlaceParts(state, {}, {{4, 14, &closure}}, {});
  const Vec3 up = state.gravity().up;
  EXPECT_NEAR((state.frames[14].T_world_cam.so3().inverse() * up - up).norm(), 0, 1e-9);
}

TEST(PlaceParts, WhatIsJoinedAlreadyStays) {
  MapState state = FourParts();
  const LoopClosure closure = At({});
  const FrameStore::Revision before = state.frames.revision();
  PlaceParts(state, {{4, 14, &closure}}, {{5, 15, &closure}, {2, 3, &closure}}, {});
  EXPECT_EQ(state.frames.revision(), before);
}

TEST(PlaceBeside, IsFarFromTheMapAndAsTheOdometryHasIt) {
  const MapState state = FourParts();
  const Pose T_odom_cam = Pose::Trans(-8000, 2, 4) * Pose::RotY(1);
  const Pose T = PlaceBeside(state, T_odom_cam);
  EXPECT_EQ(T.so3().matrix(), T_odom_cam.so3().matrix());
  EXPECT_NEAR(state.gravity().up.dot(T.translation() - T_odom_cam.translation()), 0, 1e-9);
  for (const FrameRecord& frame : state.frames)
    EXPECT_GT((frame.T_world_cam.translation() - T.translation()).norm(), 4999);
  EXPECT_LT((state.frames.back().T_world_cam.translation() - T.translation()).norm(), 5400);
}

}  // namespace
}  // namespace sslcd
