// SPDX-License-Identifier: BSD-3-Clause
#include "loop_fusion.h"

#include <cstdio>
#include <exception>
#include <list>
#include <mutex>
#include <utility>

#include "detection_folder.h"
#include "keyframe.h"    // VINS's
#include "pose_graph.h"  // VINS's
#include "vins_config.h"

namespace sslcd::vins {
namespace {

constexpr int kSayWhyEvery = 200;  // keyframes without a loop

void Say(const std::string& text) {
  std::printf("[object loops] %s\n", text.c_str());
  std::fflush(stdout);
}

Pose PoseOf(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  return Pose(lie::SO3<double>::FromMatrix(R), t);
}

}  // namespace

LoopFusion::LoopFusion(::PoseGraph& graph) : graph_(graph) {}
LoopFusion::~LoopFusion() = default;

void LoopFusion::SetDetector(Detector detector, const LabelTable& labels) {
  detector_ = std::move(detector);
  labels_ = labels;
}

void LoopFusion::Start(const std::string& config_file) {
  try {
    const VinsConfig config = ReadVinsConfig(config_file);
    for (const std::string& note : config.notes) Say(note);
    rig_ = config.rig;
    if (!detector_ && !config.detections.empty()) {
      folder_ = std::make_unique<DetectionFolder>(config.detections);
      labels_ = folder_->labels();
      detector_ = [this](double stamp) {
        if (!folder_->Has(stamp)) ++without_detections_;
        return folder_->At(stamp);
      };
    }
    if (!detector_) return Say("off: no detector, and no sslcd_detections in " + config_file);
    mapper_ = std::make_unique<AsyncMapper>(MapperOptions(rig_), ContextOf(rig_, labels_));
    const std::lock_guard lock(graph_.m_keyframelist);
    graph_.object_loops = this;
  } catch (const std::exception& error) {
    return Say(std::string("off: ") + error.what());
  }
  Say(rig_.imu ? "on, with an IMU: up is +z" : "on, without an IMU: up is the first camera's -y");
}

void LoopFusion::BeginSequence(int sequence) {
  if (sequence_ != -1 && sequence != sequence_) mapper_->StartSequence();
  sequence_ = sequence;
}

void LoopFusion::AddKeyFrame(const KeyFrame& keyframe, const Eigen::Vector3d& t_body_cam,
                             const Eigen::Matrix3d& R_body_cam) {
  if (!mapper_) return;
  BeginSequence(keyframe.sequence);
  Keyframe own;
  own.index = keyframe.index;
  own.sequence = keyframe.sequence;
  own.T_odom_body = PoseOf(keyframe.origin_vio_R, keyframe.origin_vio_T);
  own.T_body_cam = RigidFromMatrix(R_body_cam, t_body_cam).value_or(rig_.T_body_cam);
  own.has_own_loop = keyframe.has_loop;
  book_.AddKeyframe(own);
  mapper_->AddFrame(MakeFrame(own, keyframe.time_stamp, detector_(keyframe.time_stamp)));
  if (++keyframes_ % kSayWhyEvery == 0 && book_.accepted() == 0) snapshot_ = mapper_->Snapshot();
}

void LoopFusion::TakeLoops() {
  if (!mapper_) return;
  const AsyncReport report = mapper_->TakeReport();
  Report(report);
  Use(report.changes);
  SayWhyThereAreNone();
}

void LoopFusion::Report(const AsyncReport& report) {
  if (report.dropped > 0) Say(std::to_string(report.dropped) + " keyframes dropped: too slow");
  if (report.refused > 0) Say(report.refusal);
  if (report.failure.empty()) return;
  Say("off: " + report.failure);
  mapper_.reset();  // loops so far stay
}

void LoopFusion::SayWhyThereAreNone() {
  if (!snapshot_.valid() ||
      snapshot_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  try {
    const LoopSearchSummary summary = snapshot_.get().SummariseLoopSearch();
    Say(summary.Text());
    if (without_detections_ > 0)
      Say(std::to_string(without_detections_) + " of " + std::to_string(keyframes_) +
          " keyframes have no frame in sslcd_detections with their stamp");
  } catch (const std::future_error&) {  // the mapper has failed, and Report says so
  }
}

void LoopFusion::Use(const MapChanges& changes) {
  const EdgeChanges edges = book_.Update(changes.loops, changes.scale);
  if (!edges.empty()) Apply(edges);
}

void LoopFusion::Wait() {
  if (mapper_) mapper_->Wait();
}

// The optimiser reads earliest_loop_index with one of the two locks (apply.sh has it read it again
// with the other), and takes a loop to an older keyframe for a fatal error.
void LoopFusion::Apply(const EdgeChanges& changes) {
  const std::scoped_lock lock(graph_.m_keyframelist, graph_.m_optimize_buf);
  for (const int index : changes.cleared) Clear(index);
  for (const LoopEdge& edge : changes.set) Set(edge);
  graph_.optimize_buf.push(graph_.keyframelist.back()->index);
  Say(std::to_string(costs_.size()) + " of " + std::to_string(book_.accepted()) +
      " accepted loops in the pose graph");
}

void LoopFusion::Clear(int index) {
  KeyFrame* cur = Find(index);
  if (!cur || costs_.erase(index) == 0) return;
  cur->has_loop = false;
  cur->loop_index = -1;
  Say("loop at keyframe " + std::to_string(index) + " taken back");
}

void LoopFusion::Set(const LoopEdge& edge) {
  KeyFrame* cur = Find(edge.cur);
  const KeyFrame* old = Find(edge.old);
  if (!cur || !old) return;
  const Pose& T_old_cur = edge.measured.T_a_b;
  AlignSequence(*cur, *old, T_old_cur);
  if (graph_.earliest_loop_index > edge.old || graph_.earliest_loop_index == -1)
    graph_.earliest_loop_index = edge.old;
  cur->loop_info = LoopInfoOf(T_old_cur, old->vio_R_w_i, cur->vio_R_w_i);
  cur->loop_index = edge.old;
  cur->has_loop = true;

  const double yaw = YawDegrees(old->vio_R_w_i) * M_PI / 180;
  const Eigen::Matrix3d tilt = lie::SO3<double>::RotZ(-yaw).matrix() * old->vio_R_w_i;
  const bool is_new = costs_.count(edge.cur) == 0;
  costs_[edge.cur] = {{T_old_cur.translation(), cur->loop_info[7], tilt,
                       WeightOf(FourDofCovariance(edge.measured, old->vio_R_w_i), kFourDofWeight)},
                      {T_old_cur.translation(), Eigen::Quaterniond(T_old_cur.so3().matrix()),
                       WeightOf(SixDofCovariance(edge.measured), kSixDofWeight)}};
  if (!is_new) return;
  char text[120];
  std::snprintf(text, sizeof text, "loop %d -> %d, %.0f degrees, %.1f m", edge.cur, edge.old,
                T_old_cur.so3().Log().norm() * 180 / M_PI, T_old_cur.translation().norm());
  Say(text);
}

KeyFrame* LoopFusion::Find(int index) const {
  for (KeyFrame* keyframe : graph_.keyframelist)
    if (keyframe->index == index) return keyframe;
  return nullptr;
}

// Odometry does not join two sequences. The first loop between them moves the newer one to where
// the loop wants it, or the optimiser would begin far off.
void LoopFusion::AlignSequence(const KeyFrame& cur, const KeyFrame& old, const Pose& T_old_cur) {
  if (cur.sequence == old.sequence || graph_.sequence_loop[cur.sequence]) return;
  const Pose T_world_cur = PoseOf(old.vio_R_w_i, old.vio_T_w_i) * T_old_cur;
  const Pose T_vio_cur = PoseOf(cur.vio_R_w_i, cur.vio_T_w_i);
  lie::SO3<double> turn = T_world_cur.so3() * T_vio_cur.so3().inverse();
  if (rig_.imu) {  // both worlds have z up
    const Eigen::Matrix3d R = turn.matrix();
    turn = lie::SO3<double>::RotZ(std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1)));
  }
  const Pose shift(turn, T_world_cur.translation() - turn * T_vio_cur.translation());
  for (KeyFrame* keyframe : graph_.keyframelist) {
    if (keyframe->sequence != cur.sequence) continue;
    const Pose moved = shift * PoseOf(keyframe->vio_R_w_i, keyframe->vio_T_w_i);
    keyframe->updateVioPose(moved.translation(), moved.so3().matrix());
  }
  const Pose world = shift * PoseOf(graph_.w_r_vio, graph_.w_t_vio);
  graph_.w_r_vio = world.so3().matrix();
  graph_.w_t_vio = world.translation();
  graph_.sequence_loop[cur.sequence] = true;
}

ceres::CostFunction* LoopFusion::WeighFourDof(const KeyFrame& cur,
                                              ceres::CostFunction* stock) const {
  const auto at = costs_.find(cur.index);
  if (at == costs_.end()) return stock;
  delete stock;
  return FourDofLoopCost::Create(at->second.four_dof);
}

ceres::CostFunction* LoopFusion::WeighSixDof(const KeyFrame& cur,
                                             ceres::CostFunction* stock) const {
  const auto at = costs_.find(cur.index);
  if (at == costs_.end()) return stock;
  delete stock;
  return SixDofLoopCost::Create(at->second.six_dof);
}

}  // namespace sslcd::vins
