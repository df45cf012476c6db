// SPDX-License-Identifier: BSD-3-Clause
// What the bridge could not use, counted by its reason.
#pragma once

#include <array>
#include <string>

namespace sslcd::ros_bridge {

enum class Drop {
  kOdometryUnusable,      ///< a pose that is not finite, or a quaternion without unit length
  kOdometryOtherFrame,    ///< frame or child frame are not those of the first message
  kOdometryDuplicate,     ///< the stamp of the message before
  kOdometryOutOfOrder,    ///< a little older than the message before
  kOdometryLost,          ///< its covariance says that it was lost
  kCovarianceUnusable,    ///< not finite or negative: the covariance alone is not used
  kDetectionsOtherFrame,  ///< no transform joins their frame, the camera and the base
  kDetectionsOutOfOrder,  ///< no newer than a frame that was made, or the stamp of one that waits
  kDetectionsWithoutOdometry,  ///< older than all odometry that is kept, or in a gap of it
  kDetectionsWaited,           ///< too many waited for odometry; the newest one goes
  kDetectionsTooSoon,          ///< less than min_interval_s after the frame before: wanted
  kDetectionsAtRestart,        ///< waited when time was set back
  kObject,                     ///< a detection with an unusable pose, size, label or score
  kTransform,                  ///< an unusable transform
  kFrameQueueFull,             ///< the mapper is too slow
  kFrameRefused,               ///< the mapper has refused a frame
  kCount
};

/// In a few words.
const char* ToString(Drop reason);

class Drops {
 public:
  void Count(Drop reason, int count = 1) { counts_[Index(reason)] += count; }
  int operator[](Drop reason) const { return counts_[Index(reason)]; }
  /// All that was not wanted, so without kDetectionsTooSoon.
  int defects() const;
  /// All reasons that have occurred, e.g. "3 odometry: duplicate stamp; 1 object unusable"; empty:
  /// none.
  std::string Text() const;
  friend bool operator==(const Drops& a, const Drops& b) { return a.counts_ == b.counts_; }
  friend bool operator!=(const Drops& a, const Drops& b) { return !(a == b); }

 private:
  static std::size_t Index(Drop reason) { return static_cast<std::size_t>(reason); }
  std::array<int, static_cast<std::size_t>(Drop::kCount)> counts_{};
};

}  // namespace sslcd::ros_bridge
