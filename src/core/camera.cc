// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/camera.h"

#include <algorithm>
#include <cmath>

#include "sslcd/core/error.h"

namespace sslcd {

Camera RightOf(const StereoCamera& stereo) {
  Camera right = stereo.left;
  right.cx -= stereo.disparity_at_infinity;
  right.offset.x() -= stereo.baseline_m;
  return right;
}

StereoCamera MakeStereoCamera(const Camera& left, const Camera& right) {
  constexpr double kSame = 1e-3;  // [px], [m]
  const double baseline = left.offset.x() - right.offset.x();
  const bool rectified = std::abs(left.fx - right.fx) < kSame &&
                         std::abs(left.fy - right.fy) < kSame &&
                         std::abs(left.cx - right.cx) <= StereoCamera::kMostAtInfinity &&
                         std::abs(left.cy - right.cy) < kSame;
  if (!rectified || !(baseline > kSame))
    throw Error(ErrorKind::kBadInput,
                "the two cameras are no rectified pair: P2 and P3 of calib.txt (of grey images P0 "
                "and P1) must agree in their "
                "first three columns, but for up to 3 px between the columns of their principal "
                "points, and the fourth must "
                "put the right camera to the right of the left one");
  return {left, baseline, left.cx - right.cx};
}

void CheckSize(const ImageView& image, const Camera& camera) {
  if (camera.width <= 0 || (camera.width == image.width && camera.height == image.height)) return;
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  throw Error(ErrorKind::kBadInput, "the images are " + size(image.width, image.height) +
                                        ", the camera's " + size(camera.width, camera.height) +
                                        ": give the calibration of these images");
}

double Iou(const Box2d& a, const Box2d& b) {
  const Box2d both{std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
                   std::min(a.bottom, b.bottom)};
  const double intersection = both.Area();
  return intersection > 0 ? intersection / (a.Area() + b.Area() - intersection) : 0.;
}

}  // namespace sslcd
