// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/patch_alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace sslcd {
namespace {

Camera TestCamera() {
  Camera camera;
  camera.fx = 200;
  camera.fy = 210;
  camera.cx = 160;
  camera.cy = 120;
  camera.width = 320;
  camera.height = 240;
  return camera;
}

Eigen::Vector2d Project(const Vec3& p) {
  const Camera c = TestCamera();
  return {c.fx * p.x() / p.z() + c.cx, c.fy * p.y() / p.z() + c.cy};
}

/// A patterned plane: `normal` . x = 1 in the axes of a camera at the origin, seen from
/// `T_first_camera`.
struct Wall {
  Vec3 normal;

  Vec3 Meet(const Vec3& from, const Vec3& ray) const {
    return from + ray * ((1 - normal.dot(from)) / normal.dot(ray));
  }

  Vec3 At(double column, double row) const {
    const Camera c = TestCamera();
    return Meet(Vec3::Zero(), {(column - c.cx) / c.fx, (row - c.cy) / c.fy, 1});
  }

  cv::Mat Look(const Pose& T_first_camera, double brighter = 0) const {
    const Camera c = TestCamera();
    cv::Mat image(c.height, c.width, CV_8U);
    for (int row = 0; row < c.height; ++row) {
      for (int column = 0; column < c.width; ++column) {
        const Vec3 ray =
            T_first_camera.so3() * Vec3((column - c.cx) / c.fx, (row - c.cy) / c.fy, 1);
        const Vec3 p = Meet(T_first_camera.translation(), ray);
        const double wave =
            std::sin(9 * p.x() + 2 * p.y()) + std::sin(7 * p.y() - 3 * p.x() + 4 * p.z() + 1);
        image.at<unsigned char>(row, column) =
            cv::saturate_cast<unsigned char>(110 + 40 * wave + brighter);
      }
    }
    return image;
  }
};

const Vec3 kFacing(0, 0, 1 / 6.), kLevel(0, 1 / 1.3, 0);

Pose Ahead() { return Pose::Trans(0.1, -0.05, 0.8) * Pose::RotY(0.03); }

TEST(PatchAlignment, PlaneHomographyTakesPixelsToWhereThePlaneAppears) {
  for (const Vec3& normal : {kFacing, kLevel, Vec3(0.1, 0.2, 0.1)}) {
    const Wall wall{normal};
    const Pose T_to_from = Ahead().inverse();
    const auto homography = PlaneHomography(TestCamera(), T_to_from, wall.At(190, 200), 3 * normal);
    ASSERT_TRUE(homography.has_value());
    for (const double row : {170., 200., 230.}) {
      const Eigen::Vector2d there = Vec3(*homography * Vec3(150, row, 1)).hnormalized();
      EXPECT_LT((there - Project(T_to_from * wall.At(150, row))).norm(), 1e-9)
          << normal.transpose() << ", " << row;
    }
  }
}

TEST(PatchAlignment, PlaneHomographyKnowsWhatCannotBeSeen) {
  const Camera camera = TestCamera();
  EXPECT_FALSE(PlaneHomography(camera, Pose::Trans(0, 0, -7), {0, 0, 6}, kFacing))
      << "behind the second camera";
  EXPECT_FALSE(PlaneHomography(camera, Pose(), {0, 0, -6}, kFacing)) << "behind the first";
  EXPECT_FALSE(PlaneHomography(camera, Pose(), {1, 0, 6}, kLevel)) << "edge on";
}

TEST(PatchAlignment, FindsAWarpedPatchInOtherLight) {
  const Wall wall{kLevel};
  const cv::Point2f at(190.3F, 199.6F);
  const Patch patch{wall.Look(Pose()), at, wall.At(at.x, at.y), 6};
  const Pose T_to_from = Ahead().inverse();
  const Eigen::Vector2d truth = Project(T_to_from * patch.point);
  const auto homography = PlaneHomography(TestCamera(), T_to_from, patch.point, kLevel);
  ASSERT_TRUE(homography.has_value());
  const cv::Mat to = wall.Look(Ahead(), 25);
  const cv::Point2f guess(static_cast<float>(truth.x() + 0.8), static_cast<float>(truth.y() - 0.6));
  const auto found = AlignPatch(patch, *homography, to, guess);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->at.x, truth.x(), 0.03);
  EXPECT_NEAR(found->at.y, truth.y(), 0.03);
  EXPECT_LT(found->difference, 2) << "only what rounding and interpolation do";
}

TEST(PatchAlignment, IsNotFoundWhereItIsNot) {
  const Wall wall{kFacing};
  const cv::Mat image = wall.Look(Pose());
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  const cv::Point2f at(100, 100);
  const Patch patch{image, at, wall.At(100, 100), 4};
  EXPECT_TRUE(AlignPatch(patch, same, image, at));
  EXPECT_FALSE(AlignPatch(patch, same, image, {105, 100})) << "too far from the guess";
  const cv::Mat part = image.colRange(97, image.cols);
  EXPECT_FALSE(AlignPatch(patch, same, part, {3, 100})) << "there, but not as a whole";
  EXPECT_TRUE(AlignPatch(patch, same, image.colRange(90, image.cols), {10, 100}));
  EXPECT_FALSE(AlignPatch({image, {3, 100}, patch.point, 4}, same, image, {3, 100}))
      << "the patch is not in its own";
  Eigen::Matrix3d endless = same;
  endless(2, 1) = -0.01;  // the row through the patch's middle is at infinity
  EXPECT_FALSE(AlignPatch(patch, endless, image, at)) << "not finite";
  Eigen::Matrix3d mirrored = same, collapsed = same;
  mirrored(0, 0) = -1;
  mirrored(0, 2) = 200;
  collapsed(0, 0) = 0.01;
  collapsed(0, 2) = 99;
  EXPECT_FALSE(AlignPatch(patch, mirrored, image, at)) << "seen from behind";
  EXPECT_FALSE(AlignPatch(patch, collapsed, image, at)) << "seen edge on";
  cv::Mat ramp(image.size(), CV_8U);
  for (int row = 0; row < ramp.rows; ++row)
    for (int column = 0; column < ramp.cols; ++column)
      ramp.at<unsigned char>(row, column) =
          cv::saturate_cast<unsigned char>(0.5 * column + 30 * std::sin(0.5 * row) + 40);
  EXPECT_FALSE(AlignPatch({ramp, at, patch.point, 4}, same, ramp, at))
      << "a shift to the right is more light";
  const cv::Mat flat(image.size(), CV_8U, cv::Scalar(90));
  EXPECT_FALSE(AlignPatch({flat, at, patch.point, 4}, same, image, at)) << "no texture";
}

TEST(PatchAlignment, FindPatchTellsWallsFromFloors) {
  for (const Vec3& normal : {kFacing, kLevel}) {
    const Wall wall{normal};
    const cv::Mat from = wall.Look(Pose()), to = wall.Look(Ahead());
    const Pose T_to_from = Ahead().inverse();
    const Vec3 other = normal == kFacing ? kLevel : kFacing;
    for (float column = 130; column <= 190; column += 10) {
      const cv::Point2f at(column, 195);
      const Patch patch{from, at, wall.At(at.x, at.y), 6};
      const Eigen::Vector2d truth = Project(T_to_from * patch.point);
      const cv::Point2f guess(static_cast<float>(truth.x()), static_cast<float>(truth.y()));
      const auto off = [&](const cv::Point2f& p) {
        return std::hypot(p.x - truth.x(), p.y - truth.y());
      };
      const auto found = FindPatch(patch, TestCamera(), T_to_from, to, guess);
      ASSERT_TRUE(found.has_value()) << column;
      EXPECT_LT(off(*found), 0.06) << normal.transpose();
      const auto wrong = PlaneHomography(TestCamera(), T_to_from, patch.point, other);
      ASSERT_TRUE(wrong.has_value());
      const auto mistaken = AlignPatch(patch, *wrong, to, guess);
      ASSERT_TRUE(mistaken.has_value()) << column;
      EXPECT_GT(off(mistaken->at), 2 * off(*found)) << column;
    }
  }
}

}  // namespace
}  // namespace sslcd
