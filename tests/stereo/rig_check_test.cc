// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/stereo/rig_check.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "sslcd/core/error.h"
#include "tunnel.h"

namespace sslcd {
namespace {

Image Copy(const cv::Mat& grey) { return {{grey.data, grey.data + grey.total()}, grey.cols, grey.rows, 1}; }

/// A drive ahead, whose right images lie some pixels to the right of and below where calibration has them, and both are
/// distorted.
struct Rig {
  std::vector<std::pair<Image, Image>> pairs;

  Rig(double right_px, double down_px, double tangential = 0, int frames = 20) {
    for (int i = 0; i < frames; ++i) {
      const Tunnel::Pair seen = Tunnel().Look(Pose::Trans(0, 0, 0.4 * i));
      pairs.emplace_back(Copy(Seen(seen.left, 0, 0, tangential)),
                         Copy(Seen(seen.right, right_px, down_px, tangential)));
    }
  }
  static cv::Mat Seen(const cv::Mat& image, double right_px, double down_px, double tangential) {
    const Camera camera = Tunnel::Camera().left;
    cv::Mat columns(image.size(), CV_32F), rows(image.size(), CV_32F), seen;
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        const double x = (u - right_px - camera.cx) / camera.fx, y = (v - down_px - camera.cy) / camera.fy;
        columns.at<float>(v, u) = static_cast<float>(camera.cx + camera.fx * (x - 2 * tangential * x * y));
        rows.at<float>(v, u) = static_cast<float>(camera.cy + camera.fy * (y - tangential * (x * x + 3 * y * y)));
      }
    }
    cv::remap(image, seen, columns, rows, cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
    return seen;
  }
  RigCheck Check(StereoCamera camera = Tunnel::Camera(), const StereoOdometryOptions& options = {}) const {
    return CheckRig(
        camera, pairs.size(), [&](std::size_t i) { return pairs[i]; }, options);
  }
};

TEST(CheckRig, FindsTheDisparityAtInfinity) {
  for (double shift : {-0.5, 0.4}) {
    const RigCheck check = Rig(-shift, 0.3).Check();
    ASSERT_TRUE(check.row_error);
    EXPECT_NEAR(*check.row_error, 0.3, 0.05);
    EXPECT_NEAR(check.camera.disparity_at_infinity, shift, 0.08);
  }
}

TEST(CheckRig, FindsTangentialDistortion) {
  for (double p1 : {-0.006, 0.004}) {  // up to 2 px
    const RigCheck check = Rig(0, 0.3, p1).Check();
    EXPECT_NEAR(check.camera.left.tangential, p1, 0.0015);
    EXPECT_NEAR(check.camera.disparity_at_infinity, 0, 0.08);
  }
}

TEST(CheckRig, StartsFromCalibration) {
  StereoCamera camera = Tunnel::Camera();
  camera.disparity_at_infinity = 0.6;
  EXPECT_NEAR(Rig(-0.4, 0.3).Check(camera).camera.disparity_at_infinity, 0.4, 0.08);
}

TEST(CheckRig, BelievesACalibrationThatFitsRows) {
  const RigCheck check = Rig(-0.4, 0).Check();
  ASSERT_TRUE(check.row_error);
  EXPECT_LT(*check.row_error, 0.03);
  EXPECT_EQ(check.camera.disparity_at_infinity, 0);
}

TEST(CheckRig, LeavesCalibrationAloneIfAskedTo) {
  StereoOdometryOptions options;
  options.calibrate = false;
  const RigCheck check = Rig(-0.4, 0.3).Check(Tunnel::Camera(), options);
  EXPECT_TRUE(check.row_error);
  EXPECT_EQ(check.camera.disparity_at_infinity, 0);
}

TEST(CheckRig, TellsNothingWithoutMotionOrImages) {
  Rig still(-0.4, 0.3, 0, 1);
  still.pairs.resize(20, still.pairs[0]);
  EXPECT_EQ(still.Check().camera.disparity_at_infinity, 0);
  const auto missing = [](std::size_t) { return std::nullopt; };
  const RigCheck none = CheckRig(Tunnel::Camera(), 20, missing, {});
  EXPECT_FALSE(none.row_error);
  EXPECT_EQ(none.camera.disparity_at_infinity, 0);
  EXPECT_EQ(CheckRig(Tunnel::Camera(), 0, missing, {}).camera.disparity_at_infinity, 0);
}

TEST(CheckRig, RefusesImagesThatAreNoPair) {
  Rig rig(0, 0.3);
  rig.pairs[3].second = {};
  EXPECT_THROW(rig.Check(), Error);
}

}  // namespace
}  // namespace sslcd
