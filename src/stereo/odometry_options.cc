// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/stereo/odometry.h"

#include <algorithm>
#include <cmath>

namespace sslcd {

void DescribeFields(FieldVisitor& v, StereoOdometryOptions& o) {
  v.Integer("points", o.points, 50, 5000,
            "image points followed, spread over the image; time grows with them");
  v.Real("min_corner", o.min_corner, 0, 1,
         "a corner's least share of the strength of the strongest one");
  v.Integer("patch_px", o.patch_px, 5, 51, "side of the patches that are compared");
  v.Real("min_disparity_px", o.min_disparity_px, 0.05, 100,
         "points further away than that are not used");
  v.Real("max_row_error_px", o.max_row_error_px, 0.1, 10,
         "rows that a point's left and right image may be apart");
  v.Real("ransac_px", o.ransac_px, 0.1, 20,
         "a point fits a pose if it appears so near to where it should");
  v.Integer("ransac_iterations", o.ransac_iterations, 10, 10000, "samples at most");
  v.Integer("min_tracked", o.min_tracked, 6, 1000, "with fewer points that fit, a frame is lost");
  v.Integer("window", o.window, 3, 50, "keyframes adjusted together; the oldest two stand still");
  v.Real("keyframe_px", o.keyframe_px, 0, 1000,
         "median way of the points after which a keyframe is due");
  v.Real("keyframe_share", o.keyframe_share, 0, 1,
         "a keyframe is due when fewer of its points are still followed");
  v.Integer("patience", o.patience, 0, 100,
            "frames in a row lost before it starts anew where it believes to be");
  v.Flag("calibrate", o.calibrate,
         "before, find the disparity at infinity from the images, where rows show that calibration "
         "is off");
}

OdometryNoise StereoOdometryNoise(std::optional<double> row_error_rad) {
  constexpr double kIdealWalk = 1e-4, kRealWalk = 5e-4;  // [rad per sqrt(m)]
  // safe side: KITTI's walk by as much as their rows are off
  constexpr double kFactor = 2;
  OdometryNoise noise;
  noise.rotation_walk = row_error_rad
                            ? std::min(kRealWalk, std::hypot(kIdealWalk, kFactor * *row_error_rad))
                            : kRealWalk;
  const double share = noise.rotation_walk / kRealWalk;
  noise.rotation_floor_rad = 1e-4;
  noise.rotation_turn = share * 0.002;
  noise.translation_floor_m = 0.001;
  // twice what ideal images have
  noise.translation_walk = noise.vertical_walk = std::max(0.002, share * 0.005);
  return noise;
}

const char* ToString(OdometryStatus status) {
  constexpr const char* kNames[] = {"first", "tracked", "lost"};
  return kNames[static_cast<int>(status)];
}

}  // namespace sslcd
