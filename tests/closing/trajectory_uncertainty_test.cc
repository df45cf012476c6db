// SPDX-License-Identifier: BSD-3-Clause
#include "closing/trajectory_uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace sslcd {
namespace {

using Mat6 = TrajectoryUncertainty::Mat6;

constexpr double kVertexM = 20;

// Straight ahead along z, a frame every metre; y is down.
MapState Straight(int metres) {
  MapState state{ObjectMap(GravityFrame{}, LabelTable{}, {}, {}, {}), {}};
  for (int i = 0; i <= metres; ++i) {
    FrameRecord record;
    record.frame = i;
    record.T_odom_cam = record.T_world_cam = Pose::Trans(0, 0, i);
    state.frames.Append(record);
  }
  return state;
}

OdometryModel Model(const OdometryFactors& factors = {}) {
  OdometryModel model;
  model.noise.translation_floor_m = 0.02;
  model.noise.translation_walk = 0.03;
  model.noise.vertical_walk = 0.05;
  model.noise.rotation_floor_rad = 1e-3;
  model.noise.rotation_walk = 2e-3;
  model.factors = factors;
  return model;
}

// Of the motion of the world at a point, by moving it.
Eigen::Matrix3d AtPoint(const Mat6& covariance, const Vec3& point) {
  Eigen::Matrix<double, 3, 6> motion;
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
    step[i] = kStep;
    motion.col(i) = (Pose::Exp(step) * point - point) / kStep;
  }
  return motion * covariance * motion.transpose();
}

LoopClosure Measured(double variance) {
  LoopClosure closure;
  closure.covariance = variance * Mat6::Identity();
  return closure;
}

// Each edge of 20 m adds its translation, and its rotation times what is left of the path.
// The variances along directions are those of the covariance.
void ExpectVariancesOf(const TrajectoryUncertainty& uncertainty, int from, int to) {
  for (int i = 0; i < 6; ++i) {
    const double expected = uncertainty.Between(from, to)(i, i);
    EXPECT_NEAR(uncertainty.Variance(from, to, TrajectoryUncertainty::Vec6::Unit(i)), expected,
                1e-6 * expected)
        << i;
  }
}

TEST(TrajectoryUncertainty, GrowsAlongAStraightPathAsTheNoiseSays) {
  const MapState state = Straight(200);
  const OdometryModel model = Model();
  const TrajectoryUncertainty uncertainty(state, {}, model);
  ASSERT_EQ(uncertainty.frames().size(), 11u);
  const OdometrySigmas step = SigmasOf(Pose::Trans(0, 0, kVertexM), model.noise);
  for (const int edges : {1, 4, 10}) {
    const int end = static_cast<int>(kVertexM) * edges;
    double levers = 0;
    for (int left = 0; left < edges; ++left) levers += std::pow(kVertexM * left, 2);
    const double turned = step.rotation * step.rotation * levers;
    const Mat6 covariance = uncertainty.Between(0, end);
    const Eigen::Matrix3d end_moves = AtPoint(covariance, Vec3(0, 0, end));
    EXPECT_NEAR(end_moves(0, 0), edges * std::pow(step.horizontal, 2) + turned, 1e-6) << edges;
    EXPECT_NEAR(end_moves(1, 1), edges * std::pow(step.vertical, 2) + turned, 1e-6) << edges;
    EXPECT_NEAR(end_moves(2, 2), edges * std::pow(step.horizontal, 2), 1e-6) << edges;
    for (int i = 3; i < 6; ++i)
      EXPECT_NEAR(covariance(i, i), edges * std::pow(step.rotation, 2), 1e-9) << edges;
  }
}

TEST(TrajectoryUncertainty, FactorsScaleTheirCoordinates) {
  const MapState state = Straight(20);  // one edge
  const auto diagonal = [&](const OdometryFactors& factors) -> Eigen::Matrix<double, 6, 1> {
    const Mat6 covariance = TrajectoryUncertainty(state, {}, Model(factors)).Between(0, 20);
    const Vec3 end = AtPoint(covariance, Vec3(0, 0, 20)).diagonal();
    Eigen::Matrix<double, 6, 1> both;
    both << end, covariance.diagonal().tail<3>();
    return both;
  };
  const Eigen::Matrix<double, 6, 1> one = diagonal({}), scaled = diagonal({2, 3, 5, 7});
  Eigen::Matrix<double, 6, 1> expected;
  expected << 4, 25, 4, 49, 9, 49;  // y is vertical
  EXPECT_TRUE(scaled.cwiseQuotient(one).isApprox(expected, 1e-4))
      << scaled.cwiseQuotient(one).transpose();
}

TEST(TrajectoryUncertainty, ALoopIsASecondWayBetweenItsEnds) {
  const MapState state = Straight(200);
  const LoopClosure closure = Measured(1e-3);
  const TrajectoryUncertainty without(state, {}, Model()),
      with(state, {{40, 180, &closure}}, Model());
  const Mat6 to_world = state.frames[180].T_world_cam.Adj();
  const Mat6 loop = to_world * Mat6(closure.covariance) * to_world.transpose();
  const Mat6 expected = (without.Between(40, 180).inverse() + loop.inverse()).inverse();
  EXPECT_TRUE(with.Between(40, 180).isApprox(expected, 1e-6));
  const Vec3 query = state.frames[180].T_world_cam.translation();
  EXPECT_LT(AtPoint(with.Between(40, 180), query).trace(),
            0.1 * AtPoint(without.Between(40, 180), query).trace());
  EXPECT_LT(with.Between(0, 200).trace(), without.Between(0, 200).trace());
  ExpectVariancesOf(with, 40, 180);
  EXPECT_TRUE(with.Between(0, 40).isApprox(without.Between(0, 40), 1e-6)) << "before the loop";
}

TEST(TrajectoryUncertainty, WhereALoopEndsBesideAVertexOdometryLeadsThere) {
  const MapState state = Straight(200);
  const LoopClosure closure = Measured(1e-6);
  const TrajectoryUncertainty at(state, {{40, 180, &closure}}, Model()),
      beside(state, {{44, 175, &closure}}, Model());
  EXPECT_GT(beside.Between(40, 180)(1, 1), at.Between(40, 180)(1, 1) + 1e-3);
  EXPECT_LT(beside.Between(40, 180).trace(),
            TrajectoryUncertainty(state, {}, Model()).Between(40, 180).trace());
}

TEST(TrajectoryUncertainty, LoopsBetweenTheSamePlacesCountOnce) {
  const MapState state = Straight(200);
  const LoopClosure exact = Measured(1e-3), poor = Measured(1e-1);
  const Mat6 once = TrajectoryUncertainty(state, {{41, 180, &exact}}, Model()).Between(40, 180);
  for (const std::vector<LoopEdge>& loops :
       {std::vector<LoopEdge>{{41, 180, &exact}, {39, 181, &poor}},
        std::vector<LoopEdge>{{39, 181, &poor}, {41, 180, &exact}},
        std::vector<LoopEdge>{{41, 180, &exact}, {41, 180, &exact}}})
    EXPECT_EQ(TrajectoryUncertainty(state, loops, Model()).Between(40, 180), once);
  const Mat6 elsewhere =
      TrajectoryUncertainty(state, {{41, 180, &exact}, {0, 200, &exact}}, Model()).Between(40, 180);
  EXPECT_LT(elsewhere.trace(), once.trace());
}

TEST(TrajectoryUncertainty, ALoopWithinOneVertexSaysNothing) {
  const MapState state = Straight(100);
  const LoopClosure closure = Measured(1e-6);
  EXPECT_EQ(TrajectoryUncertainty(state, {{38, 43, &closure}}, Model()).Between(0, 100),
            TrajectoryUncertainty(state, {}, Model()).Between(0, 100));
}

TEST(TrajectoryUncertainty, FramesCountAsTheVertexNextToThem) {
  const MapState state = Straight(200);
  const TrajectoryUncertainty uncertainty(state, {}, Model());
  EXPECT_EQ(uncertainty.Between(0, 109), uncertainty.Between(0, 100));
  EXPECT_EQ(uncertainty.Between(0, 111), uncertainty.Between(0, 120));
  EXPECT_EQ(uncertainty.Between(3, 9), Mat6::Zero());
  EXPECT_EQ(uncertainty.Between(3, 100), uncertainty.Between(0, 100));
  EXPECT_EQ(uncertainty.Between(200, 195), Mat6::Zero());
}

TEST(TrajectoryUncertainty, ALongRunHasAHundredEdgesAtMost) {
  const TrajectoryUncertainty uncertainty(Straight(5000), {}, Model());
  EXPECT_LE(uncertainty.frames().size(), 102u);
  EXPECT_GT(uncertainty.frames().size(), 90u);
}

TEST(TrajectoryUncertainty, OfASingleFrame) {
  EXPECT_EQ(TrajectoryUncertainty(Straight(0), {}, Model()).Between(0, 0), Mat6::Zero());
}

// The same as Straight(), lost at two steps in a row.
MapState LostAt(int frame) {
  const MapState straight = Straight(200);
  MapState state{straight.map, FrameStore(100)};
  for (const FrameRecord& record : straight.frames) {
    const bool lost = record.frame == frame || record.frame == frame + 1;
    state.frames.Append(record, lost ? std::optional(StepUncertainty{true}) : std::nullopt);
  }
  return state;
}

TEST(TrajectoryUncertainty, ALostStepPartsTheTrajectoryUntilALoopJoinsIt) {
  EXPECT_TRUE(TrajectoryUncertainty(Straight(200), {}, Model()).Joined(0, 200));
  const MapState state = LostAt(107);
  const TrajectoryUncertainty lost(state, {}, Model());
  EXPECT_TRUE(lost.Joined(0, 106));
  EXPECT_TRUE(lost.Joined(108, 200));
  EXPECT_FALSE(lost.Joined(106, 108));
  EXPECT_FALSE(lost.Joined(200, 0));
  EXPECT_GT(lost.Between(106, 108)(0, 0), 1e6);
  EXPECT_TRUE(lost.Between(0, 100).isApprox(
      TrajectoryUncertainty(Straight(200), {}, Model()).Between(0, 100), 1e-6));

  const LoopClosure closure = Measured(1e-3);
  const TrajectoryUncertainty joined(state, {{40, 180, &closure}}, Model());
  EXPECT_TRUE(joined.Joined(0, 200));
  EXPECT_TRUE(joined.Joined(106, 108));
  EXPECT_LT(joined.Between(40, 180).trace(), 1e4);
  const TrajectoryUncertainty beside(state, {{0, 60, &closure}, {120, 180, &closure}}, Model());
  EXPECT_FALSE(beside.Joined(0, 200)) << "loops on either side";
}

// Found on poles 00 as four sessions: the solver said that they are not connected.
TEST(TrajectoryUncertainty, OfPartsThatStandFarApart) {
  MapState state = LostAt(107);
  constexpr double kFar = 30000;
  for (int f = 107; f <= 200; ++f)
    state.frames.SetPose(f, Pose::Trans(kFar, 0, 0) * state.frames[f].T_world_cam);
  const OdometryModel model = Model({0.1, 0.1, 0.1, 1e-4});
  const LoopClosure closure = Measured(1e-10);
  const TrajectoryUncertainty apart(state, {{110, 190, &closure}}, model);
  EXPECT_FALSE(apart.Joined(0, 200));
  EXPECT_GT(apart.Between(0, 200)(0, 0), 1e6);
  // as one part would have it at the place of the second
  MapState whole = Straight(200);
  for (int f = 0; f <= 200; ++f)
    whole.frames.SetPose(f, Pose::Trans(kFar, 0, 0) * whole.frames[f].T_world_cam);
  const TrajectoryUncertainty alone(whole, {}, model);
  const Vec3 end(kFar, 0, 128);
  const Eigen::Matrix3d moves =
      AtPoint(TrajectoryUncertainty(state, {}, model).Between(108, 128), end);
  EXPECT_TRUE(moves.isApprox(AtPoint(alone.Between(100, 120), end - Vec3(0, 0, 8)), 1e-3));
  EXPECT_LT(apart.Between(108, 188).trace(), alone.Between(108, 188).trace());
  for (const int from : {0, 108}) ExpectVariancesOf(apart, from, 188);
}

}  // namespace
}  // namespace sslcd
