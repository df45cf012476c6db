// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/jet.h>
#include <lie/se3_map.h>

#include <array>

#include "elements.h"

namespace lie::test {
namespace {

using Eigen::Vector3d;

const SE3d kPose = SE3d::Trans(1, -2, 3) * SE3d::RotX(0.3) * SE3d::RotY(-1.1);

TEST(SE3Map, AliasesTheMemory) {
  std::array<double, 9> memory{};
  memory.front() = memory.back() = 42;
  SE3Map<double> map(memory.data() + 1);
  map = kPose;
  for (int i = 0; i < 7; ++i) EXPECT_EQ(memory[i + 1], kPose.data()[i]);
  EXPECT_EQ(memory.front(), 42);
  EXPECT_EQ(memory.back(), 42);
  memory[7] = 5.0;
  EXPECT_EQ(map.translation().z(), 5.0);
  map.translation() = Vector3d(7, 8, 9);
  EXPECT_EQ(memory[5], 7.0);
  map.unit_quaternion() = Eigen::Quaterniond(0, 1, 0, 0);
  EXPECT_EQ(memory[1], 1.0);
  EXPECT_EQ(map.data(), memory.data() + 1);
}

TEST(SE3Map, AssignsThroughAndFromItself) {
  double a[7], b[7];
  SE3Map<double> map_a(a), map_b(b);
  map_a = kPose;
  map_b = map_a;
  EXPECT_EQ(map_b.data(), b);
  EXPECT_TRUE(Near(map_b.Get(), kPose, 0.0));
  map_a = map_a * map_b;
  EXPECT_TRUE(Near(map_a.Get(), kPose * kPose, 0.0));
  EXPECT_TRUE(Near(map_b.Get(), kPose, 0.0));
}

TEST(SE3Map, BehavesLikeTheElement) {
  const SE3d other = SE3d::Trans(0, 1, 0) * SE3d::RotZ(2);
  const SE3ConstMap<double> map(kPose.data());
  const Vector3d p(1, 2, 3);
  const SE3d copy = map;
  EXPECT_TRUE(Near(copy, kPose, 0.0));
  EXPECT_TRUE(Near(map * other, kPose * other, 0.0));
  EXPECT_TRUE(Near(other * map, other * kPose, 0.0));
  EXPECT_TRUE(Near(map * map, kPose * kPose, 0.0));
  EXPECT_TRUE(Near(map * p, kPose * p, 0.0));
  EXPECT_TRUE(Near(map.inverse(), kPose.inverse(), 0.0));
  EXPECT_TRUE(Near(map.so3(), kPose.so3(), 0.0));
  EXPECT_TRUE(Near(map.rotation(), kPose.rotation(), 0.0));
  EXPECT_TRUE(Near(map.Log(), kPose.Log(), 0.0));
  EXPECT_TRUE(Near(map.matrix(), kPose.matrix(), 0.0));
  EXPECT_EQ(map.translation().x(), kPose.translation().x());
  EXPECT_EQ(map.unit_quaternion().w(), kPose.unit_quaternion().w());
}

TEST(SE3Map, OverDualNumbers) {
  using Jet = ceres::Jet<double, 7>;
  Jet memory[7];
  for (int i = 0; i < 7; ++i) memory[i] = Jet(kPose.data()[i], i);
  const SE3ConstMap<Jet> map(memory);
  const Eigen::Matrix<Jet, 3, 1> p = map * Vector3d(1, 2, 3);
  const Vector3d expected = kPose * Vector3d(1, 2, 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(p[i].a, expected[i], 1e-15);
    for (int j = 0; j < 3; ++j) EXPECT_EQ(p[i].v[4 + j], i == j ? 1.0 : 0.0);
  }
}

}  // namespace
}  // namespace lie::test
