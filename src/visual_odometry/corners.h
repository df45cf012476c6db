// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "stereo/image_pyramids.h"

namespace sslcd {

/// Finds the strongest corner (smaller eigenvalue of the gradients' covariance: Shi and Tomasi,
/// Good features to track, CVPR 1994) of each cell without a point of `taken`, on a grid of about
/// `cells` cells. Corners are sorted by cell, row by row, have subpixel positions and lie less than
/// a patch outside of their cell.
std::vector<cv::Point2f> SpreadCorners(const StereoPyramids& images,
                                       const std::vector<cv::Point2f>& taken, int cells,
                                       int patch_px);

}  // namespace sslcd
