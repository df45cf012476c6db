// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "sslcd/core/camera.h"

namespace sslcd {

/// A pair of grey images of the same size.
struct GreyPair {
  cv::Mat left, right;
  double disparity_at_infinity = 0;  ///< [px], see StereoCamera
};
GreyPair GreyOf(const StereoView& images, const StereoCamera& camera);

/// Disparities of a part of the left image, relative to the disparity at infinity. Element (row,
/// column) of `values` belongs to the pixel (x0 + step_x * column, y0 + step_y * row) of the whole
/// image.
struct DisparityPatch {
  cv::Mat values;  ///< CV_32F, in pixels of the whole image; NaN: unknown
  double x0 = 0, y0 = 0, step_x = 1, step_y = 1;
};

/// Semi-global matching (Hirschmueller 2008, OpenCV's) inside `box`, for disparities in (0,
/// max_disparity]. Scales the box by `scale_x` and `scale_y` first, for finer or faster results.
/// Empty if the box has no pixel in the image.
DisparityPatch MatchInside(const GreyPair& images, const Box2d& box, double max_disparity,
                           double scale_x, double scale_y);

}  // namespace sslcd
