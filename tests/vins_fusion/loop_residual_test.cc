// SPDX-License-Identifier: BSD-3-Clause
#include "loop_residual.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "loop_costs.h"

namespace sslcd::vins {
namespace {

using SO3 = lie::SO3<double>;

// VINS's order of angles: Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Matrix3d FromAngles(double yaw_deg, const Eigen::Matrix3d& tilt) {
  return SO3::RotZ(yaw_deg * M_PI / 180).matrix() * tilt;
}

struct Body {
  double yaw_deg = 0;
  Eigen::Matrix3d tilt;
  Vec3 t;
  Pose T_world_body() const { return Pose(SO3::FromMatrix(FromAngles(yaw_deg, tilt)), t); }
};

Body MakeBody(const Pose& T_world_body) {
  const Eigen::Matrix3d R = T_world_body.so3().matrix();
  const double yaw = YawDegrees(R);
  return {yaw, SO3::RotZ(-yaw * M_PI / 180).matrix() * R, T_world_body.translation()};
}

// Bodies with z up (a car), with z forward (a camera), and with x up (EuRoC's IMU).
std::vector<SO3> Mountings() { return {SO3(), SO3::RotX(-M_PI / 2), SO3::RotY(-M_PI / 2 + 0.02)}; }

// Two bodies somewhere, tilted by a few degrees, 170 degrees apart, and the loop between them.
struct Meeting {
  Body old, cur;
  RelativePose loop;
  explicit Meeting(const SO3& mounting) {
    const SO3 tilted = SO3::RotX(0.03) * SO3::RotY(-0.02);
    const Pose T_old(SO3::RotZ(0.7) * tilted * mounting, {30, -4, 1});
    const Pose T_cur(SO3::RotZ(0.7 + 2.97) * tilted * mounting, {33, 2, 1.5});
    old = MakeBody(T_old);
    cur = MakeBody(T_cur);
    loop.T_a_b = T_old.inverse() * T_cur;
    Pose::Matrix6 A;
    for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = std::sin(1.7 * i);
    loop.covariance = 1e-4 * (A * A.transpose() + Pose::Matrix6::Identity());
    loop.covariance.topRows<3>() *= 20;
    loop.covariance.leftCols<3>() *= 20;
  }
  // VINS's 4-DoF residual of the two bodies for a measurement, not weighted
  Eigen::Vector4d FourDof(const Pose& measured) const {
    const LoopInfo info =
        LoopInfoOf(measured, old.T_world_body().so3().matrix(), cur.T_world_body().so3().matrix());
    Eigen::Vector4d residual;
    residual.head<3>() =
        FromAngles(old.yaw_deg, old.tilt).transpose() * (cur.t - old.t) - info.head<3>();
    residual[3] = WrapAngle(cur.yaw_deg - old.yaw_deg - info[7], 360);
    return residual;
  }
  // and the 6-DoF one
  Vec6 SixDof(const Pose& measured) const {
    const Pose T_old_cur = old.T_world_body().inverse() * cur.T_world_body();
    Vec6 residual;
    residual.head<3>() = T_old_cur.translation() - measured.translation();
    residual.tail<3>() = (measured.so3().inverse() * T_old_cur.so3()).Log();
    return residual;
  }
};

// Residuals of measurements with errors of the loop's covariance.
template <int kSize, class Residual>
Eigen::Matrix<double, kSize, kSize> Sampled(const RelativePose& loop, const Residual& residual) {
  const Pose::Matrix6 L = loop.covariance.llt().matrixL();
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  constexpr int kSamples = 40000;
  Eigen::Matrix<double, kSize, kSize> sum = Eigen::Matrix<double, kSize, kSize>::Zero();
  for (int i = 0; i < kSamples; ++i) {
    Eigen::Matrix<double, 6, 1> d;
    for (int k = 0; k < 6; ++k) d[k] = normal(random);
    const Eigen::Matrix<double, kSize, 1> r = residual(loop.T_a_b * Pose::Exp(L * d));
    sum += r * r.transpose();
  }
  return sum / kSamples;
}

TEST(LoopInfo, HoldsTheMeasurementAndIsMetByTheTruth) {
  for (const SO3& mounting : Mountings()) {
    const Meeting meeting(mounting);
    const LoopInfo info = LoopInfoOf(meeting.loop.T_a_b, meeting.old.T_world_body().so3().matrix(),
                                     meeting.cur.T_world_body().so3().matrix());
    EXPECT_LT((info.head<3>() - meeting.loop.T_a_b.translation()).norm(), 1e-12);
    const Eigen::Quaterniond q(info[3], info[4], info[5], info[6]);
    EXPECT_LT((q.toRotationMatrix() - meeting.loop.T_a_b.so3().matrix()).norm(), 1e-12);
    EXPECT_LT(meeting.FourDof(meeting.loop.T_a_b).norm(), 1e-9);
    EXPECT_LE(std::abs(info[7]), 180);
  }
}

// The turn about z alone counts, whatever a drift of the current pose's yaw.
TEST(LoopInfo, YawDoesNotDependOnTheDrift) {
  for (const SO3& mounting : Mountings()) {
    const Meeting meeting(mounting);
    const Pose T_old = meeting.old.T_world_body();
    const Pose drifted = Pose(SO3::RotZ(0.4), {5, 1, 0}) * meeting.cur.T_world_body();
    const LoopInfo info =
        LoopInfoOf(meeting.loop.T_a_b, T_old.so3().matrix(), drifted.so3().matrix());
    const Body cur = MakeBody(drifted);  // its yaw is off by 0.4 rad
    const double off = WrapAngle(cur.yaw_deg - meeting.old.yaw_deg - info[7], 360);
    EXPECT_NEAR(off, 0.4 * 180 / M_PI, 1e-9);
  }
}

TEST(LoopCovariance, OfTheFourDofResidualIsThatOfSamples) {
  for (const SO3& mounting : Mountings()) {
    const Meeting meeting(mounting);
    const Eigen::Matrix4d expected =
        Sampled<4>(meeting.loop, [&](const Pose& T) { return meeting.FourDof(T); });
    const Eigen::Matrix4d covariance =
        FourDofCovariance(meeting.loop, meeting.old.T_world_body().so3().matrix());
    EXPECT_LT((covariance - expected).norm(), 0.03 * expected.norm());
    const Eigen::Matrix4d white =
        WeightOf(covariance, 0.3) * expected * WeightOf(covariance, 0.3).transpose();
    EXPECT_LT((white / (0.3 * 0.3) - Eigen::Matrix4d::Identity()).norm(), 0.1);
  }
}

TEST(LoopCovariance, OfTheSixDofResidualIsThatOfSamples) {
  const Meeting meeting(SO3::RotX(-M_PI / 2));
  const Pose::Matrix6 expected =
      Sampled<6>(meeting.loop, [&](const Pose& T) { return meeting.SixDof(T); });
  const Pose::Matrix6 covariance = SixDofCovariance(meeting.loop);
  EXPECT_LT((covariance - expected).norm(), 0.03 * expected.norm());
  const Pose::Matrix6 white =
      WeightOf(covariance, 0.3) * expected * WeightOf(covariance, 0.3).transpose();
  EXPECT_LT((white / (0.3 * 0.3) - Pose::Matrix6::Identity()).norm(), 0.1);
}

TEST(LoopCost, FourDofIsTheWeightedResidual) {
  for (const SO3& mounting : Mountings()) {
    const Meeting meeting(mounting);
    Vec6 d;
    d << 0.3, -0.2, 0.1, 0.01, -0.02, 0.03;
    const Pose measured = meeting.loop.T_a_b * Pose::Exp(d);
    const LoopInfo info = LoopInfoOf(measured, meeting.old.T_world_body().so3().matrix(),
                                     meeting.cur.T_world_body().so3().matrix());
    const Eigen::Matrix4d weight =
        WeightOf(FourDofCovariance(meeting.loop, meeting.old.T_world_body().so3().matrix()), 0.3);
    const std::unique_ptr<ceres::CostFunction> cost(
        FourDofLoopCost::Create({measured.translation(), info[7], meeting.old.tilt, weight}));
    // a full turn of VINS's yaw changes nothing
    for (const double turn : {0., 360., -360.}) {
      const double yaw_old = meeting.old.yaw_deg + turn;
      const double* parameters[] = {&yaw_old, meeting.old.t.data(), &meeting.cur.yaw_deg,
                                    meeting.cur.t.data()};
      Eigen::Vector4d residual;
      ASSERT_TRUE(cost->Evaluate(parameters, residual.data(), nullptr));
      EXPECT_LT((residual - weight * meeting.FourDof(measured)).norm(), 1e-9);
    }
  }
}

TEST(LoopCost, SixDofIsTheWeightedResidual) {
  const Meeting meeting(SO3::RotX(-M_PI / 2));
  Vec6 d;
  d << 0.3, -0.2, 0.1, 0.001, -0.002, 0.003;
  const Pose measured = meeting.loop.T_a_b * Pose::Exp(d);
  const Pose::Matrix6 weight = WeightOf(SixDofCovariance(meeting.loop), 3);
  const std::unique_ptr<ceres::CostFunction> cost(SixDofLoopCost::Create(
      {measured.translation(), Eigen::Quaterniond(measured.so3().matrix()), weight}));
  const Eigen::Quaterniond old(meeting.old.T_world_body().so3().matrix());
  const Eigen::Quaterniond cur(meeting.cur.T_world_body().so3().matrix());
  for (const double sign : {1., -1.}) {
    const double q_old[] = {old.w(), old.x(), old.y(), old.z()};
    const double q_cur[] = {sign * cur.w(), sign * cur.x(), sign * cur.y(), sign * cur.z()};
    const double* parameters[] = {q_old, meeting.old.t.data(), q_cur, meeting.cur.t.data()};
    Vec6 residual;
    ASSERT_TRUE(cost->Evaluate(parameters, residual.data(), nullptr));
    EXPECT_LT((residual - weight * meeting.SixDof(measured)).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace sslcd::vins
