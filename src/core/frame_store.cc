// SPDX-License-Identifier: BSD-3-Clause
#include "core/frame_store.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sslcd {

namespace {

OdometryFailures Difference(const OdometryFailures& before, const OdometryFailures& now) {
  return {std::abs(now.translation_m2 - before.translation_m2),
          std::abs(now.rotation_rad2 - before.rotation_rad2), std::abs(now.lost - before.lost)};
}

}  // namespace

void FrameStore::Append(FrameRecord record, const std::optional<StepUncertainty>& reported) {
  record.failures = steps_.Add(record.T_odom_cam, reported);
  if (!frames_.empty()) {
    const FrameRecord& before = frames_.back();
    record.travelled = before.travelled;
    const Vec3 step = record.T_odom_cam.translation() - before.T_odom_cam.translation();
    const bool lost = record.failures.lost > 0;
    if (lost != IsLost(*this, size() - 1)) record.travelled += 0.5 * lost_path_m_;
    if (!lost) record.travelled += step.norm();
    record.failures += before.failures;
  }
  frames_.push_back(std::move(record));
  if (size() == 1 || IsLost(*this, size() - 1)) parts_.push_back(size() - 1);
  Changed(size() - 1);
}

OdometryFailures FailuresBetween(const FrameStore& frames, int a, int b) {
  return Difference(frames[a].failures, frames[b].failures);
}

bool IsLost(const FrameStore& frames, int index) {
  return index > 0 && FailuresBetween(frames, index - 1, index).lost > 0;
}

bool IsLostAt(const FrameStore& frames, double path_m) {
  const int after = frames.FirstFrom(path_m);
  if (after == 0 || after == frames.size()) return false;
  if (frames[after].travelled == path_m) return false;
  return IsLost(frames, after) || IsLost(frames, after - 1);
}

void FrameStore::MarkRefined() {
  for (FrameRecord& frame : frames_) frame.T_refined_cam = frame.T_world_cam;
}

void FrameStore::SetPose(int index, const Pose& T_world_cam) {
  frames_[index].T_world_cam = T_world_cam;
  Changed(index);
}

void FrameStore::SetMatched(int index, std::vector<LandmarkId> matched) {
  frames_[index].matched = std::move(matched);
}

int FrameStore::FirstFrom(double path_m) const {
  const auto at =
      std::lower_bound(frames_.begin(), frames_.end(), path_m,
                       [](const FrameRecord& frame, double m) { return frame.travelled < m; });
  return static_cast<int>(at - frames_.begin());
}

int FrameStore::AtPath(double path_m) const {
  int index = std::min(FirstFrom(path_m), size() - 1);
  while (IsLost(*this, index)) --index;
  return index;
}

int FrameStore::FirstChangeSince(Revision revision) const {
  const auto after =
      std::upper_bound(changes_.begin(), changes_.end(), revision,
                       [](Revision r, const auto& change) { return r < change.first; });
  return after == changes_.end() ? size() : after->second;
}

void FrameStore::Changed(int index) {
  ++revision_;
  while (!changes_.empty() && changes_.back().second >= index) changes_.pop_back();
  changes_.push_back({revision_, index});
}

std::vector<Pose> PosesOf(const FrameStore& frames) {
  std::vector<Pose> poses;
  for (const FrameRecord& record : frames) poses.push_back(record.T_world_cam);
  return poses;
}

}  // namespace sslcd
