// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// A frame as the mapper remembers it.
struct FrameRecord {
  int frame = 0;                      ///< its number in the dataset
  double stamp = 0;                   ///< [s]
  double travelled = 0;               ///< path of the odometry up to this frame [m]
  Pose T_odom_cam;                    ///< gravity-aligned, see LevelOptions
  Pose T_world_cam;                   ///< the current estimate
  std::vector<Detection> detections;  ///< after the filter, without appearance vectors
  std::vector<LandmarkId> matched;    ///< landmark of each detection; value -1: none
};

/// All frames of a run, in order of time. Frames are named by their index in the store. Every pose
/// changes through it, so that a reader can ask which frames have moved since it last looked.
/// Copyable.
class FrameStore {
 public:
  /// A moment in the life of the store.
  using Revision = std::uint64_t;

  /// Adds the newest frame; fills in the path travelled.
  void Append(FrameRecord record);

  int size() const { return static_cast<int>(frames_.size()); }
  bool empty() const { return frames_.empty(); }
  const FrameRecord& operator[](int index) const { return frames_[index]; }
  const FrameRecord& front() const { return frames_.front(); }
  const FrameRecord& back() const { return frames_.back(); }
  std::vector<FrameRecord>::const_iterator begin() const { return frames_.begin(); }
  std::vector<FrameRecord>::const_iterator end() const { return frames_.end(); }

  void SetPose(int index, const Pose& T_world_cam);
  /// Does not count as a change: readers that keep landmarks learn of merged ids by name.
  void SetMatched(int index, std::vector<LandmarkId> matched);

  /// Number of the frame that is the first one at `path_m` of path or beyond; size() where the path
  /// ends before. O(log n).
  int FirstFrom(double path_m) const;

  /// The same, but the last frame where the path ends before. There must be a frame.
  int AtPath(double path_m) const;

  Revision revision() const { return revision_; }

  /// The first frame that was added or has moved after that revision; size() where there is none.
  /// O(log n).
  int FirstChangeSince(Revision revision) const;

 private:
  void Changed(int index);

  std::vector<FrameRecord> frames_;
  Revision revision_ = 0;
  // (revision, first frame it changed), both strictly ascending: a later change of an earlier frame
  // covers the ones before it.
  std::vector<std::pair<Revision, int>> changes_;
};

/// T_world_cam of all frames.
std::vector<Pose> PosesOf(const FrameStore& frames);

}  // namespace sslcd
