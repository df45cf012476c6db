// SPDX-License-Identifier: BSD-3-Clause
// Real images (KITTI odometry 02, frames 0 to 19): a car comes towards the camera and passes by on
// the left.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "formats/calib.h"
#include "sslcd/lifting/lift.h"
#include "sslcd/perception/opencv_image.h"
#include "support/temp_folder.h"

namespace sslcd {
namespace {

/// The car's boxes, by hand, of all frames in which it is wholly visible and nearer than 30 m.
const std::map<int, Box2d> kOncoming{{7, {391, 180, 462, 228}},  {8, {364, 182, 447, 236}},
                                     {9, {323, 183, 426, 246}},  {10, {265, 183, 400, 262}},
                                     {11, {170, 185, 361, 283}}, {12, {1, 186, 302, 323}}};

TEST(LiftBoxes, OncomingCarMovesSmoothlyAndHasTheSizeOfACar) {
  SSLCD_REAL_DATA(folder, "kitti-stereo-color");
  const Calibration calibration = ReadCalibration(folder + "/calib.txt");
  const StereoCamera camera = MakeStereoCamera(*calibration.left, *calibration.right);
  LiftOptions options;
  options.ground.height_m = 1.65;
  options.min_range_m = 3;
  std::vector<Vec3> track;
  for (const auto& [frame, box] : kOncoming) {
    char name[16];
    std::snprintf(name, sizeof name, "/%06d.png", frame);
    const cv::Mat left = cv::imread(folder + "/image_2" + name),
                  right = cv::imread(folder + "/image_3" + name);
    ASSERT_FALSE(left.empty() || right.empty()) << name;
    const auto lifted =
        LiftBoxes({ViewOf(left), ViewOf(right)}, camera, {{"Car", 1, box}}, options);
    ASSERT_EQ(lifted[0].status, LiftStatus::kLifted) << name << ": " << ToString(lifted[0].status);
    const Detection& car = lifted[0].detection;
    track.push_back(car.T_cam_object.translation());
    std::printf(
        "frame %d: %.2f %.2f %.2f m, %.2f x %.2f x %.2f m, yaw %.0f deg, sigma along %.2f m\n",
        frame, track.back().x(), track.back().y(), track.back().z(), car.dims.x(), car.dims.y(),
        car.dims.z(), 57.3 * GravityFrame().YawOf(car.T_cam_object.rotation()),
        lifted[0].sigmas.radial);
    EXPECT_GT(car.dims.x(), 3.4);
    EXPECT_LT(car.dims.x(), 5.2);
    EXPECT_GT(car.dims.y(), 1.5);
    EXPECT_LT(car.dims.y(), 2.1);
    EXPECT_GT(car.dims.z(), 1.25);
    EXPECT_LT(car.dims.z(), 1.85);
  }
  for (std::size_t i = 1; i + 1 < track.size(); ++i) {
    const Vec3 second = track[i + 1] - 2 * track[i] + track[i - 1];
    std::printf("second difference %.2f m\n", second.norm());
    EXPECT_LT(second.norm(), 0.5) << second.transpose();
  }
}

}  // namespace
}  // namespace sslcd
