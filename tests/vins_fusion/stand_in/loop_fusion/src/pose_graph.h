// SPDX-License-Identifier: BSD-3-Clause
// A stand-in for VINS-Fusion's pose graph: the members that object loops need, and its two kinds of
// optimisation on a thread.
#pragma once

#include <ceres/ceres.h>

#include <atomic>
#include <list>
#include <mutex>
#include <queue>
#include <thread>
#include <vector>

#include "keyframe.h"

class PoseGraph {
 public:
  PoseGraph() { sequence_loop.push_back(false); }
  ~PoseGraph() { stop(); }
  void setIMUFlag(bool _use_imu);
  void addKeyFrame(KeyFrame* cur_kf, bool flag_detect_loop);
  KeyFrame* getKeyFrame(int index);
  /// Not VINS's: optimises what waits, then ends the thread.
  void stop();
  /// Not VINS's.
  const list<KeyFrame*>& all() const { return keyframelist; }

  Vector3d w_t_vio = Vector3d::Zero();
  Matrix3d w_r_vio = Matrix3d::Identity();

 private:
  void optimize4DoF();
  void optimize6DoF();
  bool take(int& cur_index, int& first_looped_index);

  list<KeyFrame*> keyframelist;
  mutex m_keyframelist;
  mutex m_optimize_buf;
  thread t_optimization;
  queue<int> optimize_buf;
  atomic<bool> ends{false};
  int global_index = 0;
  int sequence_cnt = 0;
  vector<bool> sequence_loop;
  int earliest_loop_index = -1;
};
