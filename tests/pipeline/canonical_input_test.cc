// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/canonical_input.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/random.h"

namespace sslcd {
namespace {

Pose AnyPose(sim::Random& random) {
  const Vec3 turn(random.Uniform(-1, 1), random.Uniform(-3, 3), random.Uniform(-1, 1));
  return Pose(lie::SO3<double>::Exp(turn),
              Vec3(random.Uniform(-1e6, 1e6), random.Uniform(-1e6, 1e6), random.Uniform(-99, 99)));
}

TEST(CanonicalInput, ACameraAtTheOriginStaysWhereItIs) {
  EXPECT_EQ(StartOf(Pose(), GravityFrame()).matrix(), Pose().matrix());
}

TEST(CanonicalInput, TheFirstCameraIsTheOriginAndItsXAxisPointsForward) {
  sim::Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 up(random.Normal(), random.Normal(), random.Normal());
    const GravityFrame gravity = GravityFrame::FromUp(up);
    const lie::SO3<double> R_odom_cam =
        gravity.Upright(random.Uniform(-3, 3)) *
        lie::SO3<double>::FromMatrix(GravityFrame().Basis().transpose());
    const Pose T_odom_cam(R_odom_cam, AnyPose(random).translation());
    const Pose T_start_cam = StartOf(T_odom_cam, gravity) * T_odom_cam;
    EXPECT_LT(T_start_cam.translation().norm(), 1e-8);
    EXPECT_LT(T_start_cam.so3().Log().norm(), 1e-9);
  }
}

TEST(CanonicalInput, TheStartDoesNotDependOnTheWorld) {
  sim::Random random(2);
  for (int i = 0; i < 50; ++i) {
    const GravityFrame gravity = GravityFrame::FromUp(Vec3(0.1 * i, -1, random.Normal()));
    const Pose T_odom_cam = AnyPose(random), T_new_odom = AnyPose(random), step = AnyPose(random);
    const GravityFrame turned = GravityFrame::FromUp(T_new_odom.so3() * gravity.up);
    const Pose there = StartOf(T_new_odom * T_odom_cam, turned) * T_new_odom * T_odom_cam * step,
               here = StartOf(T_odom_cam, gravity) * T_odom_cam * step;
    EXPECT_LT((here.inverse() * there).Log().norm(), 1e-7);
    const Vec3 up = StartOf(T_odom_cam, gravity).so3() * gravity.up;
    EXPECT_LT((up - GravityFrame().up).norm(), 1e-12);
  }
}

TEST(CanonicalInput, ACameraWithAVerticalXAxisLooksForward) {
  const Pose T_odom_cam(lie::SO3<double>::RotZ(M_PI / 2), Vec3(1, 2, 3));
  const Pose T_start_cam = StartOf(T_odom_cam, GravityFrame()) * T_odom_cam;
  const Vec3 view = T_start_cam.so3() * Vec3(Vec3::UnitZ());
  EXPECT_LT((view - GravityFrame().forward).norm(), 1e-12);
}

TEST(CanonicalInput, TimesDoNotDependOnTheirOrigin) {
  for (int i = 0; i < 1000; ++i) {
    const double time = i / 30., later = 1.7e9 + time;
    EXPECT_EQ(WholeMicroseconds(later - 1.7e9), WholeMicroseconds(time + 64. - 64.)) << i;
  }
  EXPECT_EQ(WholeMicroseconds(0.333333), 0.333333);
  EXPECT_EQ(WholeMicroseconds(1e300), 1e300);
}

TEST(CanonicalInput, TheOrderOfDetectionsIsThatOfTheirContent) {
  std::vector<Detection> detections(6);
  for (int i = 0; i < 6; ++i) {
    detections[i].row = i;
    detections[i].score = i < 3 ? 0.5 : 0.9;
    detections[i].T_cam_object.translation() = Vec3(1, i / 2, 5);
  }
  detections[4].label = "Tree";
  detections[5].label = "Car";
  const auto rows = [&] {
    std::vector<int> sorted;
    for (const int at : CanonicalOrder(detections)) sorted.push_back(detections[at].row);
    return sorted;
  };
  const std::vector<int> expected{3, 5, 4, 0, 1, 2};
  EXPECT_EQ(rows(), expected);
  std::swap(detections[1], detections[5]);
  std::swap(detections[2], detections[3]);
  EXPECT_EQ(rows(), expected);
  EXPECT_TRUE(CanonicalOrder({}).empty());
}

TEST(CanonicalInput, LandmarksGoBackToTheirDetections) {
  std::vector<Detection> detections(3);
  for (int i = 0; i < 3; ++i) detections[i].row = i;
  const std::vector<int> order{2, 0, 1};
  const std::vector<Detection> sorted = InOrder(detections, order);
  std::vector<LandmarkId> ids;
  for (const Detection& detection : sorted) ids.push_back({10 + detection.row});
  EXPECT_EQ(sorted[0].row, 2);
  EXPECT_EQ(BackInOrder(ids, order), (std::vector<LandmarkId>{{10}, {11}, {12}}));
}

}  // namespace
}  // namespace sslcd
