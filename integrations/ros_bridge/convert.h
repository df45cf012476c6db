// SPDX-License-Identifier: BSD-3-Clause
// Single messages in sslcd's terms.
#pragma once

#include <optional>

#include "ros_bridge/messages.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/loop_closure.h"

namespace sslcd::ros_bridge {

/// None if a value is not finite or the quaternion's length is off 1 by more than
/// kRotationTolerance, e.g. 0 because nobody has set it.
std::optional<Pose> ToPose(const RawPose& raw);

/// What the covariance of an odometry message says.
enum class OdometryQuality {
  kGood,
  kLost,           ///< the variances of x and y are `lost_variance` or more
  kBadCovariance,  ///< NaN, infinite or negative
};
OdometryQuality QualityOf(const OdometryMessage& odometry, double lost_variance);

/// The detection with its most probable hypothesis; `T_cam_frame` is the pose of the message's
/// frame. None if pose or size are unusable, there is no hypothesis, its label is unknown, or its
/// score is no probability.
std::optional<Detection> ToDetection(const DetectionMessage& message, const Pose& T_cam_frame);

/// The loop as measured between two poses of the base instead of the camera.
RelativePose BetweenBases(const LoopClosure& loop, const Pose& T_base_cam);

}  // namespace sslcd::ros_bridge
