// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>

#include "sslcd/core/camera.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Where a point appears: column and row in the left image, column in the right one (NaN: not found
/// there). [px]
struct StereoPixel {
  double left = 0, row = 0, right = 0;
};

inline cv::Point2f ToCv(double x, double y) {
  return {static_cast<float>(x), static_cast<float>(y)};
}

/// Where a camera at the origin sees a point in front of it.
StereoPixel ProjectStereo(const StereoCamera& camera, const Vec3& point_left);

/// The point of which both images show where it is; disparity > 0.
Vec3 Triangulate(const StereoCamera& camera, const StereoPixel& pixel);

/// Whether these may be the left and right image of one point: in one row, with a disparity.
bool IsPair(const StereoCamera& camera, const cv::Point2f& left, const cv::Point2f& right);

}  // namespace sslcd
