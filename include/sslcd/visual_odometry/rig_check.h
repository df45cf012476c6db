// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

#include "sslcd/core/image.h"
#include "sslcd/visual_odometry/odometry.h"

namespace sslcd {

/// The left and right image of a frame. None: it has not both, or they are no pair.
using PairLoader = std::function<std::optional<std::pair<Image, Image>>(std::size_t frame)>;

/// How far off the calibration of a rectified pair is, as its images tell.
struct RigCheck {
  std::optional<double> row_error;  ///< RowError [px]
  /// of StereoCamera, what should be used instead of what it has [px]
  double disparity_at_infinity = 0;
  /// rows show that calibration is off, and no frames tell by how much columns are
  bool unsure = false;
};

/// Looks at pairs all over the sequence for their row error, and drives StereoOdometry through some
/// eight bursts of frames, each until its window is full. In each the disparity at infinity is
/// adjusted together with points and poses: a hundredth of a degree between the cameras, or 0.1 px,
/// is 0.5 % of the distance of a point with 20 px, and of the way that an odometry by such points
/// goes. Of KITTI's drives 09_30 and 10_03 it is -0.2 and -0.4 px.
///
/// The median of the bursts counts as much as it is surer, by their scatter, than calibration,
/// which is taken to be as far off in columns as it is in rows (RowError). Where rows fit to 0.03
/// px, or their error is not known, or what is found is less than a quarter of it, as a rolled
/// right camera has it, or options.calibrate is off, it stays.
///
/// Throws Error(kBadInput) as StereoOdometry does.
RigCheck CheckRig(const StereoCamera& camera, std::size_t frames, const PairLoader& load,
                  const StereoOdometryOptions& options);

}  // namespace sslcd
