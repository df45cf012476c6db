// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Rectified pinhole camera as a 3x4 projection P = K [I | t], the rows of KITTI's calib.txt. [px,
/// m]
struct Camera {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  /// K^-1 * (fourth column): the reference camera's origin in this camera's frame [m]
  Vec3 offset{0, 0, 0};
  int width = 0, height = 0;  ///< [px]; 0 = unknown (then the image border clips nothing)
};

/// A rectified pair. The right camera differs from the left one in its place, `baseline_m` to the
/// right, and perhaps in the column of its principal point: u_left - u_right = fx baseline_m / z +
/// disparity_at_infinity.
struct StereoCamera {
  Camera left;
  double baseline_m = 0;
  /// [px] cx of the left one less cx of the right one
  double disparity_at_infinity = 0;
  static constexpr double kMostAtInfinity = 3;  ///< [px] more than that is another rectification
};

/// The right one of a pair.
Camera RightOf(const StereoCamera& stereo);

/// Throws Error(kBadInput) unless both have the same focal lengths and principal point, but for
/// kMostAtInfinity between its columns, and the second stands to the right of the first.
StereoCamera MakeStereoCamera(const Camera& left, const Camera& right);

/// Throws Error(kBadInput) where the camera knows the size of its images, and that is another one.
void CheckSize(const ImageView& image, const Camera& camera);

/// Axis-aligned box in the image. [px]
struct Box2d {
  double left = 0, top = 0, right = 0, bottom = 0;
  double Area() const {
    return right > left && bottom > top ? (right - left) * (bottom - top) : 0.;
  }
};

/// What a 2D detector says about one object in one image.
struct ImageDetection {
  std::string label;
  double score = 1;  ///< probability that this is an object, in [0, 1]
  Box2d box;
};

/// Intersection over union, in [0, 1]; 0 when either box is empty.
double Iou(const Box2d& a, const Box2d& b);

}  // namespace sslcd
