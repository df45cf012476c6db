// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/drops.h"

#include <numeric>

namespace sslcd::ros_bridge {

const char* ToString(Drop reason) {
  switch (reason) {
    case Drop::kOdometryUnusable: return "odometry: pose not finite or no unit quaternion";
    case Drop::kOdometryOtherFrame: return "odometry: another frame";
    case Drop::kOdometryDuplicate: return "odometry: duplicate stamp";
    case Drop::kOdometryOutOfOrder: return "odometry: out of order";
    case Drop::kOdometryLost: return "odometry: lost, by its covariance";
    case Drop::kCovarianceUnusable: return "odometry: covariance unusable";
    case Drop::kDetectionsOtherFrame: return "detections: no transform to their frame";
    case Drop::kDetectionsOutOfOrder: return "detections: out of order or duplicate";
    case Drop::kDetectionsWithoutOdometry: return "detections: no odometry at their stamp";
    case Drop::kDetectionsWaited: return "detections: waited too long for odometry";
    case Drop::kDetectionsTooSoon: return "detections: within min_interval_s";
    case Drop::kDetectionsAtRestart: return "detections: waited when time was set back";
    case Drop::kObject: return "objects: unusable pose, size, label or score";
    case Drop::kTransform: return "transforms: unusable";
    case Drop::kFrameQueueFull: return "frames: the mapper is too slow";
    case Drop::kFrameRefused: return "frames: refused by the mapper";
    case Drop::kCount: break;
  }
  return "";
}

int Drops::defects() const {
  return std::accumulate(counts_.begin(), counts_.end(), 0) - (*this)[Drop::kDetectionsTooSoon];
}

std::string Drops::Text() const {
  std::string text;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] == 0) continue;
    if (!text.empty()) text += "; ";
    text += std::to_string(counts_[i]) + " " + ToString(static_cast<Drop>(i));
  }
  return text;
}

}  // namespace sslcd::ros_bridge
