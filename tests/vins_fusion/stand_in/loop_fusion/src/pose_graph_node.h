// SPDX-License-Identifier: BSD-3-Clause
// A stand-in for VINS-Fusion's loop_fusion_node: the loop over its messages, without ROS.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pose_graph.h"

struct PoseMessage {
  double stamp;
  Vector3d t;
  Matrix3d R;
  int sequence = 1;
};

struct NodeInput {
  string config_file;
  bool use_imu = false;
  Vector3d tic;
  Matrix3d qic;
  vector<PoseMessage> messages;
};

/// Adds the keyframes in turn; the first ten are skipped. `after` is called after each, and
/// `at_end` when all are there. Both run on the thread that adds keyframes.
void RunNode(const NodeInput& input, const function<void(PoseGraph&)>& after,
             const function<void(PoseGraph&)>& at_end);
