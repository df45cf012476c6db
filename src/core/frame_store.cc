// SPDX-License-Identifier: BSD-3-Clause
#include "core/frame_store.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sslcd {

namespace {

// A step is a jump if it exceeds the longest of the last kSteps ones by this factor, at least by
// this length or angle. Frames may be dropped, and a camera may start quickly. Set by hand.
constexpr int kSteps = 50, kFewestSteps = 5;
constexpr double kFactor = 8, kLeastMetres = 3, kLeastRad = 1.5;

struct Step {
  double metres, rad;
};

Step StepBetween(const FrameRecord& a, const FrameRecord& b) {
  const Pose step = a.T_odom_cam.inverse() * b.T_odom_cam;
  return {step.translation().norm(), step.so3().Log().norm()};
}

// The failures of the step to `record`, judged by the last steps of `frames`.
OdometryFailures FailuresOf(const std::vector<FrameRecord>& frames, const FrameRecord& record) {
  const int last = static_cast<int>(frames.size()) - 1;
  if (last < kFewestSteps) return {};
  Step longest{kLeastMetres / kFactor, kLeastRad / kFactor};
  for (int f = std::max(1, last - kSteps); f <= last; ++f) {
    const Step step = StepBetween(frames[f - 1], frames[f]);
    if (frames[f].failures.translation_m2 == frames[f - 1].failures.translation_m2)
      longest.metres = std::max(longest.metres, step.metres);
    if (frames[f].failures.rotation_rad2 == frames[f - 1].failures.rotation_rad2)
      longest.rad = std::max(longest.rad, step.rad);
  }
  const Step step = StepBetween(frames[last], record);
  OdometryFailures failures;
  if (step.metres > kFactor * longest.metres) failures.translation_m2 = step.metres * step.metres;
  if (step.rad > kFactor * longest.rad) failures.rotation_rad2 = step.rad * step.rad;
  return failures;
}

}  // namespace

void FrameStore::Append(FrameRecord record) {
  if (!frames_.empty()) {
    const FrameRecord& before = frames_.back();
    const Vec3 step = record.T_odom_cam.translation() - before.T_odom_cam.translation();
    record.travelled = before.travelled + step.norm();
    record.failures = FailuresOf(frames_, record);
    record.failures.translation_m2 += before.failures.translation_m2;
    record.failures.rotation_rad2 += before.failures.rotation_rad2;
  }
  frames_.push_back(std::move(record));
  Changed(size() - 1);
}

OdometryFailures FailuresBetween(const FrameStore& frames, int a, int b) {
  const OdometryFailures &one = frames[a].failures, &other = frames[b].failures;
  return {std::abs(other.translation_m2 - one.translation_m2),
          std::abs(other.rotation_rad2 - one.rotation_rad2)};
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
