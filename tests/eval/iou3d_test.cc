// SPDX-License-Identifier: BSD-3-Clause
#include "eval/iou3d.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "iou3d_reference.h"
#include "sslcd/core/pose.h"

namespace sslcd {
namespace {

Cuboid FromRow(const double (&v)[7]) { return {{v[0], v[1], v[2]}, v[3], {v[4], v[5], v[6]}}; }

class RandomBoxes {
 public:
  Cuboid Draw() {
    const auto uniform = [this](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random_);
    };
    return {{uniform(-2, 2), uniform(-2, 2), uniform(-1, 1)},
            uniform(-7, 7),
            {uniform(0.3, 5), uniform(0.3, 3), uniform(0.3, 2)}};
  }

 private:
  std::mt19937 random_{42};
};

Cuboid Moved(const Cuboid& box, double yaw, const Vec3& t) {
  const Eigen::Matrix3d R = lie::SO3<double>::RotZ(yaw).matrix();
  return {R * box.centre + t, box.yaw + yaw, box.dims};
}

TEST(Iou3dTest, EqualsShapely) {
  for (const IouReference& row : kIouReferences) {
    EXPECT_NEAR(Iou3d(FromRow(row.a), FromRow(row.b)), row.iou, 1e-11);
    EXPECT_NEAR(Iou3d(FromRow(row.b), FromRow(row.a)), row.iou, 1e-11);
  }
}

TEST(Iou3dTest, Properties) {
  RandomBoxes boxes;
  int overlapping = 0;
  for (int i = 0; i < 300; ++i) {
    const Cuboid a = boxes.Draw(), b = boxes.Draw();
    const double iou = Iou3d(a, b);
    overlapping += iou > 0;
    EXPECT_GE(iou, 0);
    EXPECT_LE(iou, 1);
    EXPECT_NEAR(iou, Iou3d(b, a), 1e-12);
    EXPECT_NEAR(Iou3d(a, a), 1, 1e-12);
    Cuboid turned = a;
    turned.yaw += M_PI;  // the same box
    EXPECT_NEAR(Iou3d(turned, b), iou, 1e-12);
    turned.yaw += M_PI / 2;
    std::swap(turned.dims.x(), turned.dims.y());
    EXPECT_NEAR(Iou3d(turned, b), iou, 1e-12);
    const double yaw = 0.1 * i;
    const Vec3 t(3. * i, -5. * i, 0.5 * i);
    EXPECT_NEAR(Iou3d(Moved(a, yaw, t), Moved(b, yaw, t)), iou, 1e-9);
  }
  EXPECT_GT(overlapping, 100);
}

TEST(Iou3dTest, FarFromTheOrigin) {
  const Cuboid a{{1e6, -2e6, 0}, 0.3, {4, 2, 1.5}};
  Cuboid b = a;
  b.centre.z() += 0.75;
  EXPECT_NEAR(Iou3d(a, b), 1. / 3, 1e-12);
}

TEST(Iou3dTest, KnownCases) {
  const Cuboid square{{0, 0, 0}, 0, {2, 2, 2}};
  Cuboid other = square;
  other.yaw = M_PI / 2;
  EXPECT_NEAR(Iou3d(square, other), 1, 1e-12);
  other.yaw = M_PI / 4;  // regular octagon
  const double octagon = 8 * (std::sqrt(2.) - 1);
  EXPECT_NEAR(FootprintIntersection(square, other), octagon, 1e-12);
  EXPECT_NEAR(Iou3d(square, other), octagon / (8 - octagon), 1e-12);

  const Cuboid inside{{0.2, -0.1, 0.3}, 0.7, {1, 0.5, 0.4}};
  EXPECT_NEAR(Iou3d(square, inside), inside.Volume() / 8, 1e-12);

  other = square;
  other.centre.x() = 1;  // half of each
  EXPECT_NEAR(Iou3d(square, other), 1. / 3, 1e-12);
  other.centre.x() = 2;  // a common face
  EXPECT_EQ(Iou3d(square, other), 0);
  other.centre = {2, 2, 2};  // a common corner
  EXPECT_EQ(Iou3d(square, other), 0);
  other.centre = {0, 0, 2.5};  // above
  EXPECT_EQ(Iou3d(square, other), 0);
  other.centre = {50, 0, 0};
  EXPECT_EQ(Iou3d(square, other), 0);
}

TEST(Iou3dTest, EmptyBoxes) {
  const Cuboid box{{0, 0, 0}, 0.4, {2, 2, 2}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double size : {0., -1., std::numeric_limits<double>::quiet_NaN()}) {
      Cuboid flat = box;
      flat.dims[axis] = size;
      EXPECT_EQ(Iou3d(flat, box), 0);
      EXPECT_EQ(Iou3d(box, flat), 0);
      EXPECT_EQ(Iou3d(flat, flat), 0);
    }
  }
}

bool Contains(const Cuboid& box, const Vec3& p) {
  const Vec3 local = lie::SO3<double>::RotZ(-box.yaw) * Vec3(p - box.centre);
  return (local.array().abs() <= 0.5 * box.dims.array()).all();
}

TEST(Iou3dTest, EqualsMonteCarlo) {
  RandomBoxes boxes;
  std::mt19937 random(7);
  for (int i = 0; i < 10; ++i) {
    const Cuboid a = boxes.Draw(), b = boxes.Draw();
    const int samples = 40000;
    int common = 0;  // points of a that lie in b
    for (int k = 0; k < samples; ++k) {
      Vec3 p;
      for (int j = 0; j < 3; ++j)
        p[j] = std::uniform_real_distribution<double>(-0.5, 0.5)(random) * a.dims[j];
      common += Contains(b, lie::SO3<double>::RotZ(a.yaw) * p + a.centre);
    }
    const double volume = a.Volume() * common / samples;
    EXPECT_NEAR(Iou3d(a, b), volume / (a.Volume() + b.Volume() - volume), 0.015);
  }
}

TEST(ToCuboidTest, UsesTheGravityFrame) {
  const GravityFrame kitti;  // up is -y
  const Pose T_cam_object = ToPose({Vec3(3, 1.5, 20), 0.6}, kitti);
  const Cuboid box = ToCuboid(T_cam_object, Vec3(4, 2, 1.5), kitti);
  EXPECT_LT((box.centre - Vec3(3, 20, -1.5)).norm(), 1e-12);
  EXPECT_NEAR(box.yaw, 0.6, 1e-12);
  EXPECT_NEAR(HorizontalDistance(box, Cuboid{}), std::hypot(3, 20), 1e-12);

  // Roll and pitch are dropped, and the IoU does not depend on which vertical frame the boxes are
  // in.
  const Pose tilted = T_cam_object * Pose::RotX(0.2);
  EXPECT_NEAR(ToCuboid(tilted, Vec3(4, 2, 1.5), kitti).yaw, 0.6, 1e-12);
}

}  // namespace
}  // namespace sslcd
