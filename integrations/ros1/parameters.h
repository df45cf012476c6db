// SPDX-License-Identifier: BSD-3-Clause
// The private parameters of the node (docs/ros.md).
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "ros_bridge/bridge.h"

namespace sslcd::ros1 {

struct Parameters {
  ros_bridge::BridgeOptions bridge;
  Options mapper;
  MapperContext context;
  std::vector<std::string> labels;  ///< by the number of the class
  std::string map_frame = "map";
  bool publish_tf = true;
  double tf_ahead_s = 0.1;  ///< map to odom is stamped so much later than the newest odometry
  double map_every_s = 5;   ///< between two maps; 0: none
};

/// Throws Error with all that is wrong: unknown parameters, other types, no labels.
Parameters ReadParameters(const ros::NodeHandle& node);

}  // namespace sslcd::ros1
