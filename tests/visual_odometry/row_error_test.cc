// SPDX-License-Identifier: BSD-3-Clause
#include "visual_odometry/row_error.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "sslcd/core/error.h"
#include "stereo/stereo_scene.h"

namespace sslcd {
namespace {

StereoScene Wall() {
  StereoScene scene;
  scene.Add(0, 9, 0, {30, 2, 12});
  scene.Render();
  return scene;
}

// Turns and shifts the right image: what a camera does that sits in its rig otherwise than
// calibration says.
cv::Mat Moved(const cv::Mat& image, double degrees, double down) {
  cv::Mat warp = cv::getRotationMatrix2D({image.cols / 2.F, image.rows / 2.F}, degrees, 1), moved;
  warp.at<double>(1, 2) += down;
  cv::warpAffine(image, moved, warp, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
  return moved;
}

TEST(RowError, OfPerfectImagesIsNextToNothing) {
  const StereoScene scene = Wall();
  const auto error = RowError(StereoScene().camera, {scene.view(), scene.view()}, {});
  ASSERT_TRUE(error);
  EXPECT_LT(*error, 0.02);
}

TEST(RowError, TellsHowFarTheRightCameraHasMoved) {
  const StereoScene scene = Wall();
  const cv::Mat lower = Moved(scene.right, 0, 0.4), turned = Moved(scene.right, 0.1, 0);
  const StereoView shifted{ViewOf(scene.left), ViewOf(lower)},
      rolled{ViewOf(scene.left), ViewOf(turned)};
  const auto shift = RowError(StereoScene().camera, {shifted, shifted}, {});
  ASSERT_TRUE(shift);
  EXPECT_NEAR(*shift, 0.4, 0.03);
  const auto turn = RowError(StereoScene().camera, {rolled, rolled}, {});
  ASSERT_TRUE(turn);
  EXPECT_NEAR(*turn, 0.3, 0.1) << "a tenth of a degree over 640 columns: up to 0.56 px either way";
}

TEST(RowError, IsUnknownWithoutEnoughToSee) {
  EXPECT_FALSE(RowError(StereoScene().camera, {}, {}));
  const cv::Mat black(360, 640, CV_8U, cv::Scalar(0)), tiny(6, 6, CV_8U, cv::Scalar(0));
  EXPECT_FALSE(RowError(StereoScene().camera, {{ViewOf(black), ViewOf(black)}}, {}));
  EXPECT_FALSE(RowError(StereoScene().camera, {{ViewOf(tiny), ViewOf(tiny)}}, {}));
}

TEST(RowError, RefusesImagesThatAreNoPair) {
  const StereoScene scene = Wall();
  const cv::Mat half = scene.right.colRange(0, 320);
  EXPECT_THROW(RowError(StereoScene().camera, {{ViewOf(scene.left), ViewOf(half)}}, {}), Error);
}

}  // namespace
}  // namespace sslcd
