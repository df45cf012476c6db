// SPDX-License-Identifier: BSD-3-Clause
// Real data; skipped where it is absent.
#include <gtest/gtest.h>

#include "eval/segment_error.h"
#include "stereo/stereo_folder.h"
#include "support/temp_folder.h"

namespace sslcd {
namespace {

struct Driven {
  std::vector<Pose> est, ref;
  int lost = 0;
};

Driven Drive(const StereoFolder& input) {
  Driven driven;
  StereoCamera camera = input.camera;
  camera.disparity_at_infinity =
      CheckRig(camera, input.left.size(), Loader(input), {}).disparity_at_infinity;
  StereoOdometry odometry(camera, {});
  for (std::size_t i = 0; i < input.left.size(); ++i) {
    const cv::Mat left = cv::imread(input.left[i], cv::IMREAD_UNCHANGED);
    const cv::Mat right = cv::imread(input.right[i], cv::IMREAD_UNCHANGED);
    const OdometryStep step = odometry.AddFrame({ViewOf(left), ViewOf(right)});
    driven.est.push_back(step.T_odom_cam);
    driven.ref.push_back(input.truth.at(i));
    driven.lost += step.status == OdometryStatus::kLost;
  }
  return driven;
}

TEST(StereoOdometryReal, KittiGrey) {
  SSLCD_REAL_DATA(data, "kitti-odometry-poses");
  Driven driven = Drive(OpenStereoFolder(data + "/../kitti-stereo-gray/seq1", data + "/06.txt"));
  EXPECT_EQ(driven.lost, 0);
  const SegmentError error = ComputeSegmentError(driven.est, driven.ref, {10, 20, 30, 40, 50});
  EXPECT_GT(error.count, 100);
  EXPECT_LT(error.translation, 0.0075) << "0.0076 as calibrated";
  // The ground truth of the first frames turns evenly where the images wobble by up to 0.15 degrees
  // a frame.
  driven.est.erase(driven.est.begin(), driven.est.begin() + 13);
  driven.ref.erase(driven.ref.begin(), driven.ref.begin() + 13);
  const SegmentError later = ComputeSegmentError(driven.est, driven.ref, {10, 20, 30, 40});
  EXPECT_LT(later.rotation_rad_per_m, 0.01 * M_PI / 180);
}

TEST(StereoOdometryReal, KittiColour) {
  SSLCD_REAL_DATA(data, "kitti-odometry-poses");
  const Driven driven = Drive(OpenStereoFolder(data + "/../kitti-stereo-color", data + "/02.txt"));
  EXPECT_EQ(driven.lost, 0);
  const SegmentError error = ComputeSegmentError(driven.est, driven.ref, {10, 20});
  EXPECT_LT(error.translation, 0.010) << "as calibrated everything is 2 % too long";
  EXPECT_LT(error.rotation_rad_per_m, 0.01 * M_PI / 180);
}

}  // namespace
}  // namespace sslcd
