// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/image.h"
#include "sslcd/visual_odometry/odometry.h"

namespace sslcd {

/// The row error of rectified images [px]: a point should have the same row in both. Corners are
/// tracked from left to right by Lucas-Kanade. Each cell of a grid over the image has the median of
/// the row errors over all pairs, which averages out noise; the result is the root mean square of
/// the cells. Points whose rows differ by more than 1.5 px do not count. None: fewer than half of
/// the cells have 20 points. Columns probably have the same error, which only motion reveals
/// (CheckRig). Such errors bias the odometry while points cross a cell and hardly change its
/// residuals: residuals of rendered images and KITTI's are similar, but the row errors are 0.006 px
/// and 0.19 (colour) or 0.45 px (grey). Throws the errors of CheckImages.
std::optional<double> RowError(const StereoCamera& camera, const std::vector<StereoView>& pairs,
                               const StereoOdometryOptions& options);

}  // namespace sslcd
