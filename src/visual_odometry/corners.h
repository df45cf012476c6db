// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "stereo/image_pyramids.h"

namespace sslcd {

/// The strongest corner (smaller eigenvalue of the gradients' covariance: Shi and Tomasi, Good
/// features to track, CVPR 1994) of each cell of a grid of about `cells` cells that has none of the
/// points `taken` in it. In the order of the cells, row by row; between pixels, and less than a
/// patch off its cell.
std::vector<cv::Point2f> SpreadCorners(const StereoPyramids& images,
                                       const std::vector<cv::Point2f>& taken, int cells,
                                       int patch_px);

}  // namespace sslcd
