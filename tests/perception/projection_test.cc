// SPDX-License-Identifier: BSD-3-Clause
#include "perception/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sslcd {
namespace {

const Camera kCamera{700, 700, 600, 200, Vec3(0, 0, 0), 1200, 400};
const Camera kEndless{700, 700, 600, 200, Vec3(0, 0, 0), 0, 0};

void ExpectNear(const Box2d& a, const Box2d& b, double tolerance) {
  EXPECT_NEAR(a.left, b.left, tolerance);
  EXPECT_NEAR(a.top, b.top, tolerance);
  EXPECT_NEAR(a.right, b.right, tolerance);
  EXPECT_NEAR(a.bottom, b.bottom, tolerance);
}

/// Reference: the box of closely spaced points on the cuboid's edges, those nearer than `near_m`
/// left out.
Box2d BoxOfEdges(const Pose& pose, const Vec3& dims, const Camera& camera, double near_m) {
  const double inf = std::numeric_limits<double>::infinity();
  Box2d box{inf, inf, -inf, -inf};
  constexpr int kSteps = 2000;
  for (int edge = 0; edge < 12; ++edge) {
    const int along = edge % 3;
    Vec3 unit;
    unit[(along + 1) % 3] = edge / 3 % 2 ? 0.5 : -0.5;
    unit[(along + 2) % 3] = edge / 6 ? 0.5 : -0.5;
    for (int i = 0; i <= kSteps; ++i) {
      unit[along] = i / static_cast<double>(kSteps) - 0.5;
      const Vec3 p = pose * Vec3(dims.cwiseProduct(unit)) + camera.offset;
      if (p.z() < near_m) continue;
      const double u = camera.fx * p.x() / p.z() + camera.cx;
      const double v = camera.fy * p.y() / p.z() + camera.cy;
      box = {std::min(box.left, u), std::min(box.top, v), std::max(box.right, u),
             std::max(box.bottom, v)};
    }
  }
  return box;
}

TEST(ProjectCuboid, IsTheKnownBoxOfACubeStraightAhead) {
  const auto box = ProjectCuboid(Pose::Trans(0, 0, 11), Vec3(2, 2, 2), kCamera);
  ASSERT_TRUE(box);
  ExpectNear(*box, {530, 130, 670, 270}, 1e-9);  // the front face is 10 m away
}

TEST(ProjectCuboid, UsesTheOffsetOfTheCamera) {
  Camera shifted = kCamera;
  shifted.offset = Vec3(0.5, 0.1, 1);
  const auto box = ProjectCuboid(Pose::Trans(0, 0, 10), Vec3(2, 2, 2), shifted);
  ASSERT_TRUE(box);
  ExpectNear(*box, {600 - 35, 200 - 63, 600 + 105, 200 + 77}, 1e-9);
}

TEST(ProjectCuboid, EqualsThePaperWhereAllIsInFrontAndInTheImage) {
  const Pose pose(lie::SO3<double>::Exp(Vec3(0.1, 0.7, -0.2)), Vec3(2, 1, 20));
  const auto box = ProjectCuboid(pose, Vec3(4, 2, 1.5), kCamera);
  ASSERT_TRUE(box);
  ExpectNear(*box, ProjectCuboidUnclipped(pose, Vec3(4, 2, 1.5), kCamera), 1e-9);
}

TEST(ProjectCuboid, CutsExactlyAtTheNearPlane) {
  for (double yaw : {0.0, 0.4, 1.1, 2.9}) {
    for (double z : {-1.0, 0.0, 0.5, 1.4, 2.2}) {
      const Pose pose(lie::SO3<double>::RotY(yaw), Vec3(3, 1, z));
      const double near_m = 0.5;
      const auto box = ProjectCuboid(pose, Vec3(4, 2, 1.5), kEndless, near_m);
      const Box2d expected = BoxOfEdges(pose, Vec3(4, 2, 1.5), kEndless, near_m);
      if (!box) {
        EXPECT_LE(expected.Area(), 0) << "yaw " << yaw << " z " << z;
        continue;
      }
      // The points can only fall short, by about their spacing.
      EXPECT_LE(box->left, expected.left + 1e-6);
      EXPECT_GE(box->right, expected.right - 1e-6);
      const double tolerance = 0.01 * std::max(box->right - box->left, box->bottom - box->top);
      ExpectNear(*box, expected, tolerance);
    }
  }
}

TEST(ProjectCuboid, WhereThePaperBreaksBehindTheCamera) {
  // A kerb-side car that the camera is just passing: its rear is behind the image plane.
  const Pose pose(lie::SO3<double>::RotY(M_PI / 2), Vec3(2.5, 0.8, 1.5));
  const auto box = ProjectCuboid(pose, Vec3(4, 1.6, 1.5), kEndless);
  ASSERT_TRUE(box);
  EXPECT_GT(box->left, kCamera.cx);  // it is on the right, so all of its image is
  EXPECT_LT(ProjectCuboidUnclipped(pose, Vec3(4, 1.6, 1.5), kEndless).left, 0);
}

TEST(ProjectCuboid, CameraInsideSeesNothingElse) {
  const auto box = ProjectCuboid(Pose(), Vec3(10, 10, 10), kCamera);
  ASSERT_TRUE(box);
  ExpectNear(*box, {0, 0, 1200, 400}, 1e-9);
}

TEST(ProjectCuboid, NoneBehindOrOutside) {
  const Vec3 dims(2, 2, 2);
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(0, 0, -5), dims, kCamera));
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(0, 0, -5), dims, kEndless));
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(50, 0, 10), dims, kCamera));
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(0, -50, 10), dims, kCamera));
  EXPECT_TRUE(ProjectCuboid(Pose::Trans(50, 0, 10), dims, kEndless));
}

TEST(ProjectCuboid, GrazingTheNearPlane) {
  const Vec3 dims(2, 2, 2);
  const double near_m = 0.25;  // exact in binary, so is the touching face
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(0, 0, near_m - 1 - 1e-9), dims, kEndless, near_m));
  // Wholly in front, the near face on the plane: its corners count.
  const auto box = ProjectCuboid(Pose::Trans(0, 0, near_m + 1), dims, kEndless, near_m);
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->right, 600 + 700 / near_m, 1e-6);
  // A hair nearer or farther changes the box by a hair.
  for (double hair : {-1e-9, 1e-9}) {
    const auto close = ProjectCuboid(Pose::Trans(0, 0, near_m + 1 + hair), dims, kEndless, near_m);
    ASSERT_TRUE(close);
    ExpectNear(*close, *box, 1e-3);
  }
}

TEST(ProjectCuboid, GrazingTheImageBorder) {
  // The right border is at x = 6/7 z; the cube's far left edge, 11 m away, is the first to reach
  // it.
  const auto box = ProjectCuboid(Pose::Trans(11 * 6. / 7 + 0.99, 0, 10), Vec3(2, 2, 2), kCamera);
  ASSERT_TRUE(box);
  EXPECT_DOUBLE_EQ(box->right, 1200);
  EXPECT_GT(box->left, 1198);
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(11 * 6. / 7 + 1.01, 0, 10), Vec3(2, 2, 2), kCamera));
}

TEST(ProjectCuboid, BadNumbersGiveNone) {
  const double nan = std::nan("");
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(0, 0, nan), Vec3(2, 2, 2), kCamera));
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(nan, 0, 10), Vec3(2, 2, 2), kCamera));
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(0, 0, 10), Vec3(2, nan, 2), kCamera));
  EXPECT_FALSE(ProjectCuboid(Pose::Trans(0, 0, 10), Vec3(0, 0, 0), kCamera));
}

}  // namespace
}  // namespace sslcd
