// SPDX-License-Identifier: BSD-3-Clause
#include "core/frame_store.h"

#include <algorithm>
#include <utility>

namespace sslcd {

void FrameStore::Append(FrameRecord record) {
  if (!frames_.empty()) {
    const FrameRecord& before = frames_.back();
    const Vec3 step = record.T_odom_cam.translation() - before.T_odom_cam.translation();
    record.travelled = before.travelled + step.norm();
  }
  frames_.push_back(std::move(record));
  Changed(size() - 1);
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

int FrameStore::AtPath(double path_m) const { return std::min(FirstFrom(path_m), size() - 1); }

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
