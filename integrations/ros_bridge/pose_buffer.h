// SPDX-License-Identifier: BSD-3-Clause
// The pose of the odometry at any recent stamp.
#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "ros_bridge/messages.h"
#include "sslcd/core/pose.h"

namespace sslcd::ros_bridge {

/// The latest poses T_odom_base. Between two of them it interpolates with constant velocity.
class PoseBuffer {
 public:
  /// Keeps poses of the last `span_s`. Poses further apart than `max_gap_s` are not interpolated.
  PoseBuffer(double span_s, double max_gap_s) : span_s_(span_s), max_gap_s_(max_gap_s) {}

  enum class Added {
    kYes,
    kDuplicate,   ///< the stamp of the newest pose
    kOutOfOrder,  ///< older than the newest pose, by up to max_gap_s
    kJumpsBack,   ///< older by more: time has been set back
  };
  /// Changes nothing unless it returns kYes. Poses before a Break() still count as the newest.
  Added Add(Stamp stamp, const Pose& T_odom_base);

  enum class Found {
    kYes,
    kNotYet,  ///< newer than the newest pose, or there is none
    kTooOld,  ///< older than the oldest pose that is kept
    kGap,     ///< the poses before and after it are too far apart
  };
  struct Answer {
    Found found = Found::kNotYet;
    Pose T_odom_base;
  };
  Answer At(Stamp stamp) const;

  /// Poses so far are not interpolated with later ones: the odometry was lost.
  void Break() { poses_.clear(); }
  /// Forgets everything.
  void Clear();
  /// Stamp of the newest pose. None: there was none yet.
  std::optional<Stamp> newest() const { return newest_; }

 private:
  double span_s_, max_gap_s_;
  std::optional<Stamp> newest_;
  std::deque<std::pair<Stamp, Pose>> poses_;  // by stamp
};

}  // namespace sslcd::ros_bridge
