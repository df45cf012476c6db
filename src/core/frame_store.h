// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/odometry_failures.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// A stored frame.
struct FrameRecord {
  int frame = 0;           ///< frame number in the dataset
  int sequence = 0;        ///< number of the sequence, from 0 on
  double stamp = 0;        ///< increases over all sequences [s]
  double input_stamp = 0;  ///< as odometry gave it [s]
  /// path of the odometry up to this frame [m], see FrameStore::Append
  double travelled = 0;
  OdometryFailures failures;          ///< up to this frame
  Pose T_input_cam;                   ///< as odometry gave it
  Pose T_odom_cam;                    ///< without systematic errors, see CorrectedOdometry
  Pose T_world_cam;                   ///< the current estimate
  std::optional<Pose> T_refined_cam;  ///< after the last refinement; none: came later
  std::vector<Detection> detections;  ///< after the filter, without appearance vectors
  std::vector<LandmarkId> matched;    ///< landmark of each detection; value -1: none
};

/// All frames of a run, in order of time, identified by their index in the store. All pose changes
/// go through the store, so that a reader can ask which frames have moved since a revision.
/// Copyable.
class FrameStore {
 public:
  /// A counter of changes.
  using Revision = std::uint64_t;

  FrameStore() = default;
  /// `lost_path_m`: the path that a lost stretch counts as, so that nothing that is compared along
  /// a shorter path spans it. Its frames are in the middle. [m]
  explicit FrameStore(double lost_path_m) : lost_path_m_(lost_path_m) {}

  /// Adds the newest frame and sets its `travelled` and `failures`. `reported` is the uncertainty
  /// of the step to it (StepJudge).
  void Append(FrameRecord record, const std::optional<StepUncertainty>& reported = std::nullopt);

  int size() const { return static_cast<int>(frames_.size()); }
  bool empty() const { return frames_.empty(); }
  const FrameRecord& operator[](int index) const { return frames_[index]; }
  const FrameRecord& front() const { return frames_.front(); }
  const FrameRecord& back() const { return frames_.back(); }
  std::vector<FrameRecord>::const_iterator begin() const { return frames_.begin(); }
  std::vector<FrameRecord>::const_iterator end() const { return frames_.end(); }

  void SetPose(int index, const Pose& T_world_cam);
  /// Corrects a frame's odometry. Does not change the revision: the estimate stays.
  void SetOdometry(int index, const Pose& T_odom_cam) { frames_[index].T_odom_cam = T_odom_cam; }
  /// Remembers the current poses as refined ones.
  void MarkRefined();
  /// Sets the landmarks of a frame's detections. Does not change the revision: readers that store
  /// landmarks are notified of merged ids.
  void SetMatched(int index, std::vector<LandmarkId> matched);

  /// Index of the first frame at or beyond `path_m` of path; size() if the path ends before. O(log
  /// n).
  int FirstFrom(double path_m) const;

  /// The same, but the last frame if the path ends before, and the frame before a lost stretch
  /// instead of a frame in it. The store must not be empty.
  int AtPath(double path_m) const;

  /// The first frame of each part: a stretch of frames between which odometry was never lost. Part
  /// k has the frames whose OdometryFailures::lost is k.
  const std::vector<int>& parts() const { return parts_; }
  /// The frame after the last one of a part.
  int EndOfPart(int part) const {
    return part + 1 < static_cast<int>(parts_.size()) ? parts_[part + 1] : size();
  }

  Revision revision() const { return revision_; }

  /// Index of the first frame that was added or moved after the revision; size() if there is none.
  /// O(log n).
  int FirstChangeSince(Revision revision) const;

 private:
  void Changed(int index);

  double lost_path_m_ = 0;
  StepJudge steps_;
  std::vector<FrameRecord> frames_;
  std::vector<int> parts_;
  Revision revision_ = 0;
  // (revision, first changed frame), both strictly ascending: a later change of an earlier frame
  // replaces previous entries.
  std::vector<std::pair<Revision, int>> changes_;
};

/// The failures of odometry between two frames.
OdometryFailures FailuresBetween(const FrameStore& frames, int a, int b);

/// Whether the step to a frame is unknown.
bool IsLost(const FrameStore& frames, int index);

/// Whether there is no camera at this path length, because odometry was lost.
bool IsLostAt(const FrameStore& frames, double path_m);

/// T_world_cam of all frames.
std::vector<Pose> PosesOf(const FrameStore& frames);

}  // namespace sslcd
