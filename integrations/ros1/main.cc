// SPDX-License-Identifier: BSD-3-Clause
// sslcd_node: object loop closure as a node of ROS 1 (docs/ros.md).
#include <exception>

#include "node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "sslcd");
  ros::NodeHandle node, own("~");
  try {
    sslcd::ros1::Node sslcd_node(node, own, sslcd::ros1::ReadParameters(own));
    ros::spin();
    sslcd_node.PrintSummary();
    return sslcd_node.failure().empty() ? 0 : 1;
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
}
