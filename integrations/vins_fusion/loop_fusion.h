// SPDX-License-Identifier: BSD-3-Clause
// Object loops for VINS-Fusion's loop_fusion_node. apply.sh inserts the calls.
#pragma once

#if __cplusplus < 201703L
#error "sslcd needs C++17: replace -std=c++11 in loop_fusion/CMakeLists.txt (apply.sh does it)"
#endif

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "loop_book.h"
#include "loop_costs.h"
#include "sslcd/pipeline/async_mapper.h"

class KeyFrame;   // VINS's
class PoseGraph;  // VINS's, which has this class as a friend

namespace sslcd::vins {

class DetectionFolder;

/// Hands VINS's keyframes to a mapper on a thread of its own, and its loops to VINS's pose graph.
/// The thread that adds keyframes makes all calls, except for WeighFourDof and WeighSixDof.
class LoopFusion {
 public:
  /// Detections of the left camera at a keyframe's stamp [s]. Called by AddKeyFrame; it may wait
  /// for a detector.
  using Detector = std::function<std::vector<Detection>(double stamp)>;

  explicit LoopFusion(::PoseGraph& graph);
  ~LoopFusion();

  /// Reads VINS's configuration. Without `sslcd_detections` and without a detector nothing is done.
  /// Prints what is wrong, and then does nothing either.
  void Start(const std::string& config_file);
  /// Takes the place of `sslcd_detections`; before Start().
  void SetDetector(Detector detector, const LabelTable& labels);

  /// After PoseGraph::addKeyFrame. `t_body_cam` and `R_body_cam`: VINS's extrinsics now; if they
  /// are no rigid transform yet, the configuration's.
  void AddKeyFrame(const KeyFrame& keyframe, const Eigen::Vector3d& t_body_cam,
                   const Eigen::Matrix3d& R_body_cam);
  /// Hands over what was found since the last call. Cheap if there is nothing.
  void TakeLoops();
  /// The same for given changes.
  void Use(const MapChanges& changes);

  /// The cost of the loop at `cur` with its covariance in place of `stock`, which is deleted, or
  /// `stock` if that loop is VINS's own. The caller holds PoseGraph::m_keyframelist.
  ceres::CostFunction* WeighFourDof(const KeyFrame& cur, ceres::CostFunction* stock) const;
  ceres::CostFunction* WeighSixDof(const KeyFrame& cur, ceres::CostFunction* stock) const;

  /// Waits until the keyframes handed in so far are mapped.
  void Wait();
  const LoopBook& book() const { return book_; }

 private:
  struct Costs {
    FourDofLoopCost four_dof;
    SixDofLoopCost six_dof;
  };

  void BeginSequence(int sequence);
  void Apply(const EdgeChanges& changes);
  void Set(const LoopEdge& edge);
  void Clear(int index);
  KeyFrame* Find(int index) const;
  void AlignSequence(const KeyFrame& cur, const KeyFrame& old, const Pose& T_old_cur);
  void Report(const AsyncReport& report);
  void SayWhyThereAreNone();

  ::PoseGraph& graph_;
  Rig rig_;
  Detector detector_;
  LabelTable labels_;
  std::unique_ptr<DetectionFolder> folder_;
  std::unique_ptr<AsyncMapper> mapper_;  // none: switched off
  LoopBook book_;
  std::map<int, Costs> costs_;  // by KeyFrame::index; needs m_keyframelist
  std::future<Mapper> snapshot_;
  int sequence_ = -1;  // of the keyframe before
  int keyframes_ = 0, without_detections_ = 0;
};

}  // namespace sslcd::vins
