// SPDX-License-Identifier: BSD-3-Clause
// A stand-in for VINS-Fusion's keyframe: the members that object loops need.
#pragma once

#include <Eigen/Dense>

using namespace Eigen;
using namespace std;

class KeyFrame {
 public:
  KeyFrame(double stamp, const Vector3d& t, const Matrix3d& R, int _sequence)
      : time_stamp(stamp),
        sequence(_sequence),
        vio_T_w_i(t),
        vio_R_w_i(R),
        T_w_i(t),
        R_w_i(R),
        origin_vio_T(t),
        origin_vio_R(R) {
    loop_info.setZero();
  }
  void updateVioPose(const Vector3d& t, const Matrix3d& R) {
    vio_T_w_i = T_w_i = t;
    vio_R_w_i = R_w_i = R;
  }

  double time_stamp;
  int index = -1;
  int sequence;
  Vector3d vio_T_w_i;
  Matrix3d vio_R_w_i;
  Vector3d T_w_i;
  Matrix3d R_w_i;
  Vector3d origin_vio_T;
  Matrix3d origin_vio_R;
  bool has_loop = false;
  int loop_index = -1;
  Matrix<double, 8, 1> loop_info;
};
