// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/visual_odometry/odometry.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "sslcd/core/error.h"
#include "stereo/tunnel.h"

namespace sslcd {
namespace {

Image Copy(const cv::Mat& grey) {
  return {{grey.data, grey.data + grey.total()}, grey.cols, grey.rows, 1};
}

/// A drive ahead, whose right images are turned and then lie some pixels to the right of and below
/// where calibration has them.
struct Rig {
  std::vector<std::pair<Image, Image>> pairs;

  Rig(double right_px, double down_px, int frames = 20, double roll_deg = 0) {
    const Camera camera = Tunnel::Camera().left;
    cv::Mat shift = cv::getRotationMatrix2D(
        {static_cast<float>(camera.cx), static_cast<float>(camera.cy)}, roll_deg, 1);
    shift.at<double>(0, 2) += right_px;
    shift.at<double>(1, 2) += down_px;
    for (int i = 0; i < frames; ++i) {
      const Tunnel::Pair seen = Tunnel().Look(Pose::Trans(0, 0, 0.4 * i));
      cv::Mat moved;
      cv::warpAffine(seen.right, moved, shift, seen.right.size(), cv::INTER_CUBIC,
                     cv::BORDER_REFLECT_101);
      pairs.emplace_back(Copy(seen.left), Copy(moved));
    }
  }
  RigCheck Check(StereoCamera camera = Tunnel::Camera(),
                 const StereoOdometryOptions& options = {}) const {
    return CheckRig(
        camera, pairs.size(), [&](std::size_t i) { return pairs[i]; }, options);
  }
};

TEST(CheckRig, FindsTheDisparityAtInfinity) {
  for (double shift : {-0.5, 0.4}) {
    const RigCheck check = Rig(-shift, 0.3).Check();
    ASSERT_TRUE(check.row_error);
    EXPECT_NEAR(*check.row_error, 0.3, 0.05);
    EXPECT_NEAR(check.disparity_at_infinity, shift, 0.08);
  }
}

TEST(CheckRig, StartsFromCalibration) {
  StereoCamera camera = Tunnel::Camera();
  camera.disparity_at_infinity = 0.6;
  EXPECT_NEAR(Rig(-0.4, 0.3).Check(camera).disparity_at_infinity, 0.4, 0.08);
}

TEST(CheckRig, BelievesACalibrationThatFitsRows) {
  const RigCheck check = Rig(-0.4, 0).Check();
  ASSERT_TRUE(check.row_error);
  EXPECT_LT(*check.row_error, 0.03);
  EXPECT_EQ(check.disparity_at_infinity, 0);
}

TEST(CheckRig, DoesNotBelieveThatImagesWereNotRectified) {
  const RigCheck check = Rig(-6, 0.3).Check();
  EXPECT_EQ(check.disparity_at_infinity, 0);
  EXPECT_TRUE(check.unsure);
}

TEST(CheckRig, DoesNotTakeARolledCameraForAnother) {
  for (double roll_deg : {-0.4, 0.2, 0.4}) {
    const RigCheck check = Rig(0, 0, 20, roll_deg).Check();
    EXPECT_GT(*check.row_error, 0.2);
    EXPECT_EQ(check.disparity_at_infinity, 0) << roll_deg;
  }
}

TEST(CheckRig, LeavesCalibrationAloneIfAskedTo) {
  StereoOdometryOptions options;
  options.calibrate = false;
  const RigCheck check = Rig(-0.4, 0.3).Check(Tunnel::Camera(), options);
  EXPECT_TRUE(check.row_error);
  EXPECT_EQ(check.disparity_at_infinity, 0);
}

TEST(CheckRig, TellsNothingWithoutMotionOrImages) {
  Rig still(-0.4, 0.3, 1);
  still.pairs.resize(20, still.pairs[0]);
  EXPECT_EQ(still.Check().disparity_at_infinity, 0);
  EXPECT_TRUE(still.Check().unsure);
  const auto missing = [](std::size_t) { return std::nullopt; };
  const RigCheck none = CheckRig(Tunnel::Camera(), 20, missing, {});
  EXPECT_FALSE(none.row_error);
  EXPECT_EQ(none.disparity_at_infinity, 0);
  EXPECT_EQ(CheckRig(Tunnel::Camera(), 0, missing, {}).disparity_at_infinity, 0);
}

TEST(CheckRig, RefusesImagesThatAreNoPair) {
  Rig rig(0, 0.3);
  rig.pairs[3].second = {};
  EXPECT_THROW(rig.Check(), Error);
}

}  // namespace
}  // namespace sslcd
