// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph_node.h"

#include <memory>

#define SKIP_FIRST_CNT 10

void RunNode(const NodeInput& input, const function<void(PoseGraph&)>& after,
             const function<void(PoseGraph&)>& at_end) {
  vector<unique_ptr<KeyFrame>> owned;
  PoseGraph posegraph;
  const string config_file = input.config_file;
  const bool USE_IMU = input.use_imu;
  const Vector3d tic = input.tic;
  const Matrix3d qic = input.qic;
  posegraph.setIMUFlag(USE_IMU);

  size_t next = SKIP_FIRST_CNT;
  bool waits = false;  // for the results of the last keyframe
  while (!waits) {
    waits = next >= input.messages.size();
    const PoseMessage* pose_msg = waits ? nullptr : &input.messages[next++];
    if (pose_msg != NULL) {
      owned.emplace_back(
          new KeyFrame(pose_msg->stamp, pose_msg->t, pose_msg->R, pose_msg->sequence));
      KeyFrame* keyframe = owned.back().get();
      posegraph.addKeyFrame(keyframe, 1);
      after(posegraph);
    }
  }
  at_end(posegraph);
  posegraph.stop();
}
