// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_msgs/TFMessage.h>

#include <future>

#include "convert_messages.h"
#include "parameters.h"

namespace sslcd::ros1 {

/// Topics in, corrections out (docs/ros.md). All callbacks run on one thread, and none waits.
class Node {
 public:
  /// Throws what Bridge throws.
  Node(ros::NodeHandle& node, ros::NodeHandle& own, const Parameters& parameters);

  /// Why the mapper has ended; empty: it runs.
  const std::string& failure() const { return failure_; }
  /// Prints what came of the run.
  void PrintSummary() const;

 private:
  void OnOdometry(const nav_msgs::Odometry& message) { bridge_.Add(FromRos(message)); }
  void OnDetections(const Detection3DArray& message) {
    bridge_.Add(FromRos(message, parameters_.labels));
  }
  void OnTransforms(const tf2_msgs::TFMessage& message);
  void Publish();
  void PublishCorrection();
  void PublishMap();
  void LogDrops();

  const Parameters parameters_;
  ros_bridge::Bridge bridge_;
  int frames_ = 0, defects_ = 0;
  bool path_is_new_ = false;
  std::future<Mapper> snapshot_;
  std::string failure_;
  ros::WallTime last_path_, last_map_, last_log_;
  ros::Subscriber odometry_, detections_, transforms_;
  ros::Publisher tf_, path_, map_;
  ros::ServiceServer refine_, restart_;
  ros::WallTimer timer_;
};

}  // namespace sslcd::ros1
