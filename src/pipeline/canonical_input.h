// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/pose.h"

namespace sslcd {

// What says the same reaches the estimator as the same numbers. Otherwise grids along the axes,
// coordinates in single precision, sums in the order of the rows and limits that a difference of
// stamps just meets would tell two equal drives apart, and a loop at the limit would come or go.

/// T_start_odom: from the odometry's world to the world in which a mapper works. Its up axis is -y,
/// its origin the first camera, whose x axis points along GravityFrame::forward (the z axis, where
/// x is vertical). The identity if the first pose is the identity and up is -y.
Pose StartOf(const Pose& T_odom_cam, const GravityFrame& gravity);

/// A time in whole microseconds, which is about what a stamp of seconds since 1970 resolves; times
/// of more than 30 years as they are. Frames closer than that may get one time, which nothing
/// divides by. [s]
double WholeMicroseconds(double time_s);

/// The indices of detections with finite values by score, the highest first, then by place,
/// rotation, size and label. Of detections that are equal in all of these the order is the input's.
std::vector<int> CanonicalOrder(const std::vector<Detection>& detections);

/// The detections in that order.
std::vector<Detection> InOrder(const std::vector<Detection>& detections,
                               const std::vector<int>& order);

/// The landmarks of detections in that order, for the detections as they were.
std::vector<LandmarkId> BackInOrder(const std::vector<LandmarkId>& sorted,
                                    const std::vector<int>& order);

}  // namespace sslcd
