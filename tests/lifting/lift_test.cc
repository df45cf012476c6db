// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/lifting/lift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sslcd/core/error.h"
#include "sslcd/pipeline/options.h"
#include "stereo/stereo_scene.h"

namespace sslcd {
namespace {

constexpr double kPi = 3.14159265358979323846;
const Vec3 kCar(4.3, 1.8, 1.5);

LiftOptions Options() {
  LiftOptions options;
  options.ground.height_m = 1.3;
  return options;
}

double YawError(const LiftedBox& lifted, double yaw) {
  return std::abs(
      WrapAngle(GravityFrame().YawOf(lifted.detection.T_cam_object.rotation()) - yaw, kPi));
}

TEST(LiftBoxes, FindsACarThatShowsTwoSides) {
  for (double yaw : {0.5, 1.0, -0.7}) {
    for (double z : {9., 14.}) {
      StereoScene scene;
      scene.camera.disparity_at_infinity = yaw > 0.7 ? 1.3 : 0;
      scene.Add(1, z, yaw, kCar);
      scene.Render();
      const auto lifted =
          LiftBoxes(scene.view(), scene.camera, {{"Car", 0.8, scene.BoxOf(0)}}, Options());
      ASSERT_EQ(lifted.size(), 1u);
      ASSERT_EQ(lifted[0].status, LiftStatus::kLifted)
          << ToString(lifted[0].status) << " yaw " << yaw << " z " << z;
      const Detection& found = lifted[0].detection;
      const Vec3 error =
          found.T_cam_object.translation() - scene.blocks[0].T_cam_object.translation();
      EXPECT_LT(error.norm(), 0.45) << "yaw " << yaw << " z " << z << ": " << error.transpose();
      EXPECT_LT(YawError(lifted[0], yaw), 0.15) << "yaw " << yaw << " z " << z;
      EXPECT_LT((found.dims - kCar).cwiseAbs().maxCoeff(), 0.5) << found.dims.transpose();
      EXPECT_EQ(found.label, "Car");
      EXPECT_EQ(found.score, 0.8);
      ASSERT_TRUE(found.box);
      EXPECT_EQ(found.box->left, scene.BoxOf(0).left);
    }
  }
}

TEST(LiftBoxes, OneSideTellsLittleOfTheLength) {
  StereoScene scene;
  scene.Add(0, 10, kPi / 2, Vec3(5.2, 1.8, 1.5));  // from behind
  scene.Render();
  const auto lifted =
      LiftBoxes(scene.view(), scene.camera, {{"Car", 1, scene.BoxOf(0)}}, Options());
  ASSERT_EQ(lifted[0].status, LiftStatus::kLifted);
  EXPECT_LT(YawError(lifted[0], kPi / 2), 0.1);
  const ClassPrior prior = Options().classes.at("Car");
  EXPECT_NEAR(lifted[0].detection.dims.x(), prior.length_m, 0.3);
  EXPECT_NEAR(lifted[0].detection.dims.y(), 1.8, 0.15);
  EXPECT_GT(lifted[0].dims_sigma.x(), 0.8 * prior.length_sigma_m);
  EXPECT_LT(lifted[0].dims_sigma.y(), 0.12);
  EXPECT_GT(lifted[0].sigmas.radial, lifted[0].sigmas.lateral);
}

TEST(LiftBoxes, CoarseBoxesLeaveTheSidesToTheContour) {
  StereoScene scene;
  scene.Add(1, 12, 0.7, kCar);
  scene.Render();
  const Box2d exact = scene.BoxOf(0);
  const double width = exact.right - exact.left, height = exact.bottom - exact.top;
  LiftOptions told = Options();
  told.box_sigma_share = 0.12;
  double worst_told = 0, worst = 0;
  for (int i = 0; i < 8; ++i) {
    const double x = (i & 1 ? 1 : -1) * 0.15 * width, y = (i & 2 ? 1 : -1) * 0.1 * height,
                 both = i & 4 ? 1 : -1;
    const Box2d box{exact.left + x, exact.top + y, exact.right + both * x, exact.bottom + both * y};
    const auto error = [&](const LiftOptions& options) {
      const auto lifted = LiftBoxes(scene.view(), scene.camera, {{"Car", 1, box}}, options);
      const Vec3 truth = scene.blocks[0].T_cam_object.translation();
      return lifted[0].status == LiftStatus::kLifted
                 ? (lifted[0].detection.T_cam_object.translation() - truth).norm()
                 : 10.;
    };
    worst_told = std::max(worst_told, error(told));
    worst = std::max(worst, error(Options()));
  }
  EXPECT_LT(worst_told, 0.6);
  EXPECT_LT(worst_told, worst);
}

TEST(LiftBoxes, WhatIsNearerHidesWithoutMovingWhatIsBehind) {
  StereoScene scene;
  scene.Add(-1, 7, 0.1, kCar);
  scene.Add(1.5, 12, 0.2, kCar);
  scene.Render();
  Box2d visible = scene.BoxOf(1);
  visible.left = scene.BoxOf(0).right;  // as a detector sees it
  const auto lifted = LiftBoxes(scene.view(), scene.camera,
                                {{"Car", 1, visible}, {"Car", 1, scene.BoxOf(0)}}, Options());
  for (int i : {0, 1}) {
    const Block& truth = scene.blocks[1 - i];
    ASSERT_EQ(lifted[i].status, LiftStatus::kLifted) << i;
    const Vec3 error =
        lifted[i].detection.T_cam_object.translation() - truth.T_cam_object.translation();
    EXPECT_LT(error.norm(), i == 0 ? 1.2 : 0.45) << i << ": " << error.transpose();
  }
}

TEST(LiftBoxes, AnswersInTheReferenceCamera) {
  StereoScene scene;
  scene.Add(1, 10, 0.7, kCar);
  scene.Render();
  const ImageDetection box{"Car", 1, scene.BoxOf(0)};
  const auto here = LiftBoxes(scene.view(), scene.camera, {box}, Options());
  scene.camera.left.offset = {0.06, 0.01, -0.02};
  const auto there = LiftBoxes(scene.view(), scene.camera, {box}, Options());
  ASSERT_EQ(there[0].status, LiftStatus::kLifted);
  const Vec3 shift =
      here[0].detection.T_cam_object.translation() - there[0].detection.T_cam_object.translation();
  EXPECT_LT((shift - scene.camera.left.offset).norm(), 1e-12);
}

TEST(LiftBoxes, ColourAndGreyAndAnyOrderGiveTheSame) {
  StereoScene scene;
  scene.Add(-2, 8, 0.7, kCar);
  scene.Add(3, 11, 1.5, kCar);
  scene.Render();
  const ImageDetection a{"Car", 1, scene.BoxOf(0)}, b{"Car", 1, scene.BoxOf(1)};
  const auto grey = LiftBoxes(scene.view(), scene.camera, {a, b}, Options());
  cv::Mat left, right;
  cv::merge(std::vector<cv::Mat>(3, scene.left), left);
  cv::merge(std::vector<cv::Mat>(3, scene.right), right);
  const auto colour = LiftBoxes({ViewOf(left), ViewOf(right)}, scene.camera, {b, a}, Options());
  for (int i : {0, 1}) {
    const Pose &x = grey[i].detection.T_cam_object, &y = colour[1 - i].detection.T_cam_object;
    EXPECT_EQ(x.translation(), y.translation());
    EXPECT_EQ(grey[i].detection.dims, colour[1 - i].detection.dims);
    EXPECT_EQ(grey[i].sigmas.yaw, colour[1 - i].sigmas.yaw);
  }
}

TEST(LiftBoxes, BadBoxesAreRefusedOneByOne) {
  StereoScene scene;
  scene.Add(1, 10, 0.7, kCar);
  scene.Render();
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const std::vector<ImageDetection> boxes{
      {"Car", 1, {nan, 10, 20, 30}},    {"Car", 1, {10, 10, inf, 90}},
      {"Car", 1, {50, 50, 50, 90}},     {"Car", 1, {90, 90, 50, 50}},
      {"Car", 1, {-200, 10, -100, 90}}, {"Car", 1, {900, 10, 990, 90}},
      {"Car", 1, {100, 200, 160, 205}}, {"Teapot", 1, scene.BoxOf(0)},
      {"Car", 1, {100, 5, 260, 95}},  // sky
      {"Car", 1, scene.BoxOf(0)}};
  const LiftStatus expected[] = {
      LiftStatus::kBadBox,  LiftStatus::kBadBox, LiftStatus::kBadBox,   LiftStatus::kBadBox,
      LiftStatus::kBadBox,  LiftStatus::kBadBox, LiftStatus::kTooSmall, LiftStatus::kUnknownLabel,
      LiftStatus::kNoDepth, LiftStatus::kLifted};
  const auto lifted = LiftBoxes(scene.view(), scene.camera, boxes, Options());
  ASSERT_EQ(lifted.size(), boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    EXPECT_EQ(lifted[i].status, expected[i]) << i << ToString(lifted[i].status);
  EXPECT_EQ(lifted[7].detection.label, "Teapot") << "whoever reads it wants to know which";
  EXPECT_TRUE(LiftBoxes(scene.view(), scene.camera, {}, Options()).empty());
}

TEST(LiftBoxes, WithoutTextureThereIsNoDepth) {
  StereoScene scene;
  scene.texture = false;
  scene.Add(0, 10, 0.7, kCar);
  scene.Render();
  const cv::Mat black(scene.left.size(), CV_8U, cv::Scalar(0));
  const auto lifted = LiftBoxes({ViewOf(black), ViewOf(black)}, scene.camera,
                                {{"Car", 1, scene.BoxOf(0)}}, Options());
  EXPECT_EQ(lifted[0].status, LiftStatus::kNoDepth);
  // Even grey all over: nothing finite is required but an answer.
  const auto flat = LiftBoxes(scene.view(), scene.camera, {{"Car", 1, scene.BoxOf(0)}}, Options());
  const bool lost = flat[0].status == LiftStatus::kLifted &&
                    !flat[0].detection.T_cam_object.translation().allFinite();
  EXPECT_FALSE(lost);
}

TEST(LiftBoxes, OutOfRange) {
  StereoScene scene;
  scene.Add(1, 14, 0.7, kCar);
  scene.Render();
  LiftOptions options = Options();
  options.max_range_m = 8;
  const auto lifted = LiftBoxes(scene.view(), scene.camera, {{"Car", 1, scene.BoxOf(0)}}, options);
  EXPECT_EQ(lifted[0].status, LiftStatus::kOutOfRange);
}

TEST(LiftBoxes, RefusesImagesThatAreNoPair) {
  StereoScene scene;
  scene.Render();
  EXPECT_THROW(LiftBoxes({scene.view().left, {}}, scene.camera, {}, Options()), Error);
  const cv::Mat half = scene.right.colRange(0, 320);
  EXPECT_THROW(LiftBoxes({scene.view().left, ViewOf(half)}, scene.camera, {}, Options()), Error);
  scene.camera.left.width = 1280;
  EXPECT_THROW(LiftBoxes(scene.view(), scene.camera, {}, Options()), Error);
}

}  // namespace
}  // namespace sslcd
