// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph.h"

#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <map>

namespace {

constexpr double kDegrees = 180 / M_PI;

Vector3d YawPitchRoll(const Matrix3d& R) {
  const double yaw = atan2(R(1, 0), R(0, 0));
  const double pitch = asin(max(-1., min(1., -R(2, 0))));
  return Vector3d(yaw, pitch, atan2(R(2, 1), R(2, 2))) * kDegrees;
}

Matrix3d Rotation(double yaw_deg, double pitch_deg, double roll_deg) {
  return (AngleAxisd(yaw_deg / kDegrees, Vector3d::UnitZ()) *
          AngleAxisd(pitch_deg / kDegrees, Vector3d::UnitY()) *
          AngleAxisd(roll_deg / kDegrees, Vector3d::UnitX()))
      .toRotationMatrix();
}

double Wrapped(double degrees) { return remainder(degrees, 360.); }

// [translation in the old body's axes, yaw in degrees]
struct FourDof {
  Vector3d t;
  double yaw, pitch, roll, yaw_weight;
  bool operator()(const double* yaw_i, const double* t_i, const double* yaw_j, const double* t_j,
                  double* residual) const {
    const Vector3d step(t_j[0] - t_i[0], t_j[1] - t_i[1], t_j[2] - t_i[2]);
    Map<Vector3d>{residual} = Rotation(*yaw_i, pitch, roll).transpose() * step - t;
    residual[3] = yaw_weight * Wrapped(*yaw_j - *yaw_i - yaw);
    return true;
  }
  static ceres::CostFunction* Create(const FourDof& cost) {
    return new ceres::NumericDiffCostFunction<FourDof, ceres::CENTRAL, 4, 1, 3, 1, 3>(
        new FourDof(cost));
  }
};

Quaterniond FromWxyz(const double* q) { return Quaterniond(q[0], q[1], q[2], q[3]).normalized(); }

// [translation in the old body's axes, rotation], 0.1 m and 0.01 rad
struct SixDof {
  Vector3d t;
  Quaterniond q;
  bool operator()(const double* q_i, const double* t_i, const double* q_j, const double* t_j,
                  double* residual) const {
    const Vector3d step(t_j[0] - t_i[0], t_j[1] - t_i[1], t_j[2] - t_i[2]);
    const Quaterniond old = FromWxyz(q_i);
    const Quaterniond error = q.conjugate() * (old.conjugate() * FromWxyz(q_j));
    Map<Vector3d>{residual} = (old.conjugate() * step - t) / 0.1;
    Map<Vector3d>{residual + 3} = error.vec() * (error.w() < 0 ? -2 : 2) / 0.01;
    return true;
  }
  static ceres::CostFunction* Create(const SixDof& cost) {
    return new ceres::NumericDiffCostFunction<SixDof, ceres::CENTRAL, 6, 4, 3, 4, 3>(
        new SixDof(cost));
  }
};

struct State {
  KeyFrame* keyframe;
  array<double, 4> turn;  // yaw, pitch, roll [deg], or a quaternion w x y z
  array<double, 3> t;
};

// So that nothing leaks where no loop is left.
ceres::Problem::Options BorrowLoss() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

void Optimise(ceres::Problem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 5;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
}

}  // namespace

void PoseGraph::setIMUFlag(bool _use_imu) {
  t_optimization =
      thread(_use_imu ? &PoseGraph::optimize4DoF : &PoseGraph::optimize6DoF, this);
}

void PoseGraph::stop() {
  ends = true;
  if (t_optimization.joinable()) t_optimization.join();
}

void PoseGraph::addKeyFrame(KeyFrame* cur_kf, bool) {
  if (sequence_cnt != cur_kf->sequence) {
    ++sequence_cnt;
    sequence_loop.push_back(false);
    w_t_vio.setZero();
    w_r_vio.setIdentity();
  }
  cur_kf->index = global_index++;
  const Vector3d t = w_r_vio * cur_kf->vio_T_w_i + w_t_vio;
  const Matrix3d R = w_r_vio * cur_kf->vio_R_w_i;
  const lock_guard<mutex> lock(m_keyframelist);
  cur_kf->updateVioPose(t, R);
  keyframelist.push_back(cur_kf);
}

KeyFrame* PoseGraph::getKeyFrame(int index) {
  for (KeyFrame* keyframe : keyframelist)
    if (keyframe->index == index) return keyframe;
  return nullptr;
}

// Waits for an optimisation that is asked for. False: none will come.
bool PoseGraph::take(int& cur_index, int& first_looped_index) {
  while (true) {
    const bool last = ends;
    cur_index = -1;
    m_optimize_buf.lock();
    for (; !optimize_buf.empty(); optimize_buf.pop()) cur_index = optimize_buf.front();
    first_looped_index = earliest_loop_index;
    m_optimize_buf.unlock();
    if (cur_index != -1) return true;
    if (last) return false;
    this_thread::sleep_for(chrono::milliseconds(2));
  }
}

void PoseGraph::optimize4DoF() {
  int cur_index, first_looped_index;
  while (take(cur_index, first_looped_index)) {
    m_keyframelist.lock();
    KeyFrame* cur_kf = getKeyFrame(cur_index);
    map<int, State> states;
    ceres::Problem problem(BorrowLoss());
    ceres::HuberLoss huber(0.1);
    ceres::LossFunction* loss_function = &huber;
    for (auto it = keyframelist.begin(); it != keyframelist.end(); ++it) {
      if ((*it)->index < first_looped_index) continue;
      const Vector3d ypr = YawPitchRoll((*it)->vio_R_w_i);
      const Vector3d& t = (*it)->vio_T_w_i;
      State& state = states[(*it)->index] = {*it, {ypr[0], ypr[1], ypr[2], 0}, {t[0], t[1], t[2]}};
      problem.AddParameterBlock(&state.turn[0], 1);
      problem.AddParameterBlock(&state.t[0], 3);
      if ((*it)->index == first_looped_index) {
        problem.SetParameterBlockConstant(&state.turn[0]);
        problem.SetParameterBlockConstant(&state.t[0]);
      }
      const auto edge = [&](State& old, const Vector3d& step, double yaw, double yaw_weight) {
        return FourDof::Create({step, yaw, old.turn[1], old.turn[2], yaw_weight});
      };
      const auto before = states.find((*it)->index - 1);
      if (before != states.end() && before->second.keyframe->sequence == (*it)->sequence) {
        State& old = before->second;
        const Vector3d step = old.keyframe->vio_R_w_i.transpose() * (t - old.keyframe->vio_T_w_i);
        problem.AddResidualBlock(edge(old, step, state.turn[0] - old.turn[0], 1), nullptr,
                                 &old.turn[0], &old.t[0], &state.turn[0], &state.t[0]);
      }
      if ((*it)->has_loop) {
        assert((*it)->loop_index >= first_looped_index);
        State& old = states.at((*it)->loop_index);
        ceres::CostFunction* cost_function =
            edge(old, (*it)->loop_info.head<3>(), (*it)->loop_info[7], 0.1);
        problem.AddResidualBlock(cost_function, loss_function, &old.turn[0], &old.t[0],
                                 &state.turn[0], &state.t[0]);
      }
      if (*it == cur_kf) break;
    }
    m_keyframelist.unlock();
    Optimise(problem);
    const lock_guard<mutex> lock(m_keyframelist);
    for (auto& entry : states) {
      const State& state = entry.second;
      state.keyframe->T_w_i = Map<const Vector3d>(&state.t[0]);
      state.keyframe->R_w_i = Rotation(state.turn[0], state.turn[1], state.turn[2]);
    }
  }
}

void PoseGraph::optimize6DoF() {
  int cur_index, first_looped_index;
  while (take(cur_index, first_looped_index)) {
    m_keyframelist.lock();
    KeyFrame* cur_kf = getKeyFrame(cur_index);
    map<int, State> states;
    ceres::Problem problem(BorrowLoss());
    ceres::HuberLoss huber(0.1);
    ceres::LossFunction* loss_function = &huber;
    for (auto it = keyframelist.begin(); it != keyframelist.end(); ++it) {
      if ((*it)->index < first_looped_index) continue;
      const Quaterniond q((*it)->vio_R_w_i);
      const Vector3d& t = (*it)->vio_T_w_i;
      State& state = states[(*it)->index] = {
          *it, {q.w(), q.x(), q.y(), q.z()}, {t[0], t[1], t[2]}};
      problem.AddParameterBlock(&state.turn[0], 4, new ceres::QuaternionManifold());
      problem.AddParameterBlock(&state.t[0], 3);
      if ((*it)->index == first_looped_index) {
        problem.SetParameterBlockConstant(&state.turn[0]);
        problem.SetParameterBlockConstant(&state.t[0]);
      }
      const auto before = states.find((*it)->index - 1);
      if (before != states.end() && before->second.keyframe->sequence == (*it)->sequence) {
        State& old = before->second;
        const Quaterniond inverse = FromWxyz(&old.turn[0]).conjugate();
        problem.AddResidualBlock(
            SixDof::Create({inverse * (t - old.keyframe->vio_T_w_i), inverse * q}), nullptr,
            &old.turn[0], &old.t[0], &state.turn[0], &state.t[0]);
      }
      if ((*it)->has_loop) {
        assert((*it)->loop_index >= first_looped_index);
        State& old = states.at((*it)->loop_index);
        const Matrix<double, 8, 1>& info = (*it)->loop_info;
        ceres::CostFunction* loop_function =
            SixDof::Create({info.head<3>(), Quaterniond(info[3], info[4], info[5], info[6])});
        problem.AddResidualBlock(loop_function, loss_function, &old.turn[0], &old.t[0],
                                 &state.turn[0], &state.t[0]);
      }
      if (*it == cur_kf) break;
    }
    m_keyframelist.unlock();
    Optimise(problem);
    const lock_guard<mutex> lock(m_keyframelist);
    for (auto& entry : states) {
      entry.second.keyframe->T_w_i = Map<const Vector3d>(&entry.second.t[0]);
      entry.second.keyframe->R_w_i = FromWxyz(&entry.second.turn[0]).toRotationMatrix();
    }
  }
}
