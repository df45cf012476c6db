// SPDX-License-Identifier: BSD-3-Clause
// The messages that the bridge takes, as plain structs. A node of ROS 1 or ROS 2 copies its
// messages into them. Nothing in this folder knows ROS.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sslcd::ros_bridge {

/// Time since any epoch [ns]; all topics have the same one.
using Stamp = std::int64_t;

inline double Seconds(Stamp stamp) { return 1e-9 * static_cast<double>(stamp); }

/// geometry_msgs/Pose as it came: it may hold anything.
struct RawPose {
  std::array<double, 3> position{};               ///< [m]
  std::array<double, 4> orientation{0, 0, 0, 1};  ///< x y z w
};

/// nav_msgs/Odometry: the pose of `child_frame` in `frame`.
struct OdometryMessage {
  Stamp stamp = 0;
  std::string frame, child_frame;  ///< e.g. odom, base_link
  RawPose pose;
  std::array<double, 36> covariance{};  ///< 6x6 by rows, x y z first; zero: unknown
};

/// A class that an object may have.
struct Hypothesis {
  std::string label;  ///< empty: unknown
  double score = 0;   ///< probability
};

/// vision_msgs/Detection3D: a cuboid in the frame of its array. Its origin is the centre, x points
/// along its length, y to its left, z up.
struct DetectionMessage {
  std::vector<Hypothesis> hypotheses;
  RawPose pose;
  std::array<double, 3> size{};  ///< length, width, height [m]
};

/// vision_msgs/Detection3DArray: all detections of a moment, or none.
struct DetectionsMessage {
  Stamp stamp = 0;    ///< of the image or the scan
  std::string frame;  ///< of the poses, e.g. camera_optical_frame
  std::vector<DetectionMessage> detections;
};

/// geometry_msgs/TransformStamped of /tf_static: the pose of `child` in `parent`.
struct TransformMessage {
  std::string parent, child;
  RawPose pose;
};

}  // namespace sslcd::ros_bridge
