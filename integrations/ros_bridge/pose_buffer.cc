// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/pose_buffer.h"

#include <algorithm>

namespace sslcd::ros_bridge {

PoseBuffer::Added PoseBuffer::Add(Stamp stamp, const Pose& T_odom_base) {
  if (newest_ && stamp == *newest_) return Added::kDuplicate;
  if (newest_ && stamp < *newest_)
    return Seconds(*newest_ - stamp) > max_gap_s_ ? Added::kJumpsBack : Added::kOutOfOrder;
  newest_ = stamp;
  poses_.emplace_back(stamp, T_odom_base);
  while (Seconds(stamp - poses_.front().first) > span_s_) poses_.pop_front();
  return Added::kYes;
}

PoseBuffer::Answer PoseBuffer::At(Stamp stamp) const {
  if (poses_.empty() || stamp > poses_.back().first) return {Found::kNotYet, {}};
  if (stamp < poses_.front().first) return {Found::kTooOld, {}};
  const auto after = std::lower_bound(
      poses_.begin(), poses_.end(), stamp,
      [](const std::pair<Stamp, Pose>& pose, Stamp at) { return pose.first < at; });
  if (after->first == stamp) return {Found::kYes, after->second};
  const auto before = std::prev(after);
  const double gap_s = Seconds(after->first - before->first);
  if (gap_s > max_gap_s_) return {Found::kGap, {}};
  const double share = Seconds(stamp - before->first) / gap_s;
  const Pose::Tangent step = (before->second.inverse() * after->second).Log();
  return {Found::kYes, before->second * Pose::Exp(share * step)};
}

void PoseBuffer::Clear() {
  poses_.clear();
  newest_.reset();
}

}  // namespace sslcd::ros_bridge
