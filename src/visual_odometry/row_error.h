// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/image.h"
#include "sslcd/visual_odometry/odometry.h"

namespace sslcd {

/// How far rectified images are from what calibration says of them: a point should lie in one row
/// of both. Corners are found and followed from left to right by Lucas-Kanade; of each cell of a
/// grid over the image the median of their row errors over all pairs, which noise averages out of;
/// of the cells the root mean square. [px] Columns will be off as much, of which only motion tells
/// (CheckRig). That pulls the odometry one way for as long as points take to cross a cell, and
/// hardly shows in its residuals: those of rendered images and of KITTI's are nearly alike, but
/// rows differ by 0.006 px, and by 0.19 (colour) and 0.45 px (grey). None where fewer than half of
/// the cells have 20 points. Points whose rows differ by more than 1.5 px do not count.
/// Throws Error(kBadInput) as CheckImages does.
std::optional<double> RowError(const StereoCamera& camera, const std::vector<StereoView>& pairs,
                               const StereoOdometryOptions& options);

}  // namespace sslcd
