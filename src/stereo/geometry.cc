// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/geometry.h"

#include <cmath>

namespace sslcd {

StereoPixel ProjectStereo(const StereoCamera& camera, const Vec3& p) {
  const Camera& left = camera.left;
  const double column = left.fx * p.x() / p.z() + left.cx;
  const double disparity = left.fx * camera.baseline_m / p.z() + camera.disparity_at_infinity;
  return {column, left.fy * p.y() / p.z() + left.cy, column - disparity};
}

Vec3 Triangulate(const StereoCamera& camera, const StereoPixel& pixel) {
  const Camera& left = camera.left;
  const double z =
      left.fx * camera.baseline_m / (pixel.left - pixel.right - camera.disparity_at_infinity);
  return {(pixel.left - left.cx) / left.fx * z, (pixel.row - left.cy) / left.fy * z, z};
}

bool IsPair(const StereoCamera& camera, const cv::Point2f& left, const cv::Point2f& right) {
  // [px] Rows of KITTI's images differ by up to 1.2 (docs/notes, "Calibration"); a larger
  // difference means another point or images that are not rectified.
  constexpr double kMaxRowError = 1.5;
  // [px] The distance of a point with less disparity is too uncertain: an error of 0.1 px changes
  // it by a fifth.
  constexpr double kMinDisparity = 0.5;
  return std::abs(left.y - right.y) <= kMaxRowError &&
         left.x - right.x - camera.disparity_at_infinity >= kMinDisparity;
}

}  // namespace sslcd
