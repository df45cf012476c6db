// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS 1 from and to the bridge's.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "detection3d_array.h"
#include "ros_bridge/bridge.h"
#include "ros_bridge/markers.h"

namespace sslcd::ros1 {

ros_bridge::OdometryMessage FromRos(const nav_msgs::Odometry& message);
/// `labels` by the number of the class; other numbers have no label.
ros_bridge::DetectionsMessage FromRos(const Detection3DArray& message,
                                      const std::vector<std::string>& labels);
ros_bridge::TransformMessage FromRos(const geometry_msgs::TransformStamped& message);

/// `stamp` in `frame`.
std_msgs::Header HeaderOf(ros_bridge::Stamp stamp, const std::string& frame);
geometry_msgs::Pose ToRos(const Pose& pose);
geometry_msgs::TransformStamped ToRos(const Pose& T_parent_child, const std_msgs::Header& parent,
                                      const std::string& child);
nav_msgs::Path ToRos(const std::vector<ros_bridge::PathPose>& path, const std::string& frame);
/// Takes the place of all markers that were shown before.
visualization_msgs::MarkerArray ToRos(const std::vector<ros_bridge::Marker>& markers,
                                      const std_msgs::Header& header);

}  // namespace sslcd::ros1
