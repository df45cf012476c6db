// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>

#include "sslcd/core/camera.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// The pixel of a point: column and row in the left image, column in the right one (NaN: not
/// found). [px]
struct StereoPixel {
  double left = 0, row = 0, right = 0;
};

inline cv::Point2f ToCv(double x, double y) {
  return {static_cast<float>(x), static_cast<float>(y)};
}

/// Projects a point in front of the camera.
StereoPixel ProjectStereo(const StereoCamera& camera, const Vec3& point_left);

/// Triangulates a point; the disparity must be > 0.
Vec3 Triangulate(const StereoCamera& camera, const StereoPixel& pixel);

/// Whether these can be the left and right image of one point: similar row, valid disparity.
bool IsPair(const StereoCamera& camera, const cv::Point2f& left, const cv::Point2f& right);

}  // namespace sslcd
