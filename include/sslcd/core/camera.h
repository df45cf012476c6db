// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/export.h"
#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// Rectified pinhole camera as a 3x4 projection P = K [I | t], the rows of KITTI's calib.txt. [px,
/// m]
struct Camera {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< focal lengths and principal point [px]
  /// K^-1 * (fourth column): the reference camera's origin in this camera's frame [m]
  Vec3 offset{0, 0, 0};
  int width = 0, height = 0;  ///< [px]; 0: unknown (then boxes are not clipped to the image)
};

/// A rectified pair. The right camera is `baseline_m` to the right of the left one and may have
/// another column of the principal point: u_left - u_right = fx baseline_m / z +
/// disparity_at_infinity.
struct StereoCamera {
  Camera left;
  double baseline_m = 0;  ///< distance of the two cameras, > 0
  /// cx of the left camera minus cx of the right one [px]
  double disparity_at_infinity = 0;
  static constexpr double kMostAtInfinity = 3;  ///< [px] a larger value means another rectification
};

/// The right camera of a pair.
Camera RightOf(const StereoCamera& stereo);

/// Makes a pair from two cameras. Throws Error(kBadInput) unless both have the same focal lengths
/// and principal point (up to kMostAtInfinity between its columns) and the second is to the right
/// of the first.
StereoCamera MakeStereoCamera(const Camera& left, const Camera& right);

/// Throws Error(kBadInput) if the camera has an image size and the image has another one.
void CheckSize(const ImageView& image, const Camera& camera);

/// Axis-aligned box in the image. [px]
struct Box2d {
  double left = 0, top = 0, right = 0, bottom = 0;
  double Area() const {
    return right > left && bottom > top ? (right - left) * (bottom - top) : 0.;
  }
};

/// A 2D detection of one object in one image.
struct ImageDetection {
  std::string label;
  double score = 1;  ///< probability that this is an object, in [0, 1]
  Box2d box;
};

/// Intersection over union, in [0, 1]; 0 when either box is empty.
double Iou(const Box2d& a, const Box2d& b);

}  // namespace sslcd
