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

// Standard deviations of a lost step: larger than most maps, and any turn. Loops outweigh them.
constexpr double kLostMetres = 1000, kLostRad = M_PI;

struct Step {
  double metres, rad;

  // Whether a step with these failures is as long as it seems, and turns as much.
  bool IsLong(const OdometryFailures& its) const {
    return its.lost == 0 && its.translation_m2 < 0.5 * metres * metres;
  }
  bool IsTurn(const OdometryFailures& its) const {
    return its.lost == 0 && its.rotation_rad2 < 0.5 * rad * rad;
  }
};

Step StepBetween(const FrameRecord& a, const FrameRecord& b) {
  const Pose step = a.T_odom_cam.inverse() * b.T_odom_cam;
  return {step.translation().norm(), step.so3().Log().norm()};
}

OdometryFailures Difference(const OdometryFailures& before, const OdometryFailures& now) {
  return {std::abs(now.translation_m2 - before.translation_m2),
          std::abs(now.rotation_rad2 - before.rotation_rad2), std::abs(now.lost - before.lost)};
}

OdometryFailures Reported(const StepUncertainty& step) {
  if (step.lost) return {kLostMetres * kLostMetres, kLostRad * kLostRad, 1};
  return {step.translation_m * step.translation_m, step.rotation_rad * step.rotation_rad, 0};
}

// The failures of the step to `record`, judged by the last steps of `frames`.
OdometryFailures InferredFrom(const std::vector<FrameRecord>& frames, const FrameRecord& record) {
  const int last = static_cast<int>(frames.size()) - 1;
  if (last < kFewestSteps) return {};
  Step longest{kLeastMetres / kFactor, kLeastRad / kFactor};
  for (int f = std::max(1, last - kSteps); f <= last; ++f) {
    const Step step = StepBetween(frames[f - 1], frames[f]);
    const OdometryFailures its = Difference(frames[f - 1].failures, frames[f].failures);
    if (step.IsLong(its)) longest.metres = std::max(longest.metres, step.metres);
    if (step.IsTurn(its)) longest.rad = std::max(longest.rad, step.rad);
  }
  const Step step = StepBetween(frames[last], record);
  OdometryFailures failures;
  if (step.metres > kFactor * longest.metres) failures.translation_m2 = step.metres * step.metres;
  if (step.rad > kFactor * longest.rad) failures.rotation_rad2 = step.rad * step.rad;
  return failures;
}

}  // namespace

void FrameStore::Append(FrameRecord record, const std::optional<StepUncertainty>& reported) {
  if (!frames_.empty()) {
    const FrameRecord& before = frames_.back();
    record.travelled = before.travelled;
    OdometryFailures& failures = record.failures;
    failures = reported ? Reported(*reported) : InferredFrom(frames_, record);
    const Vec3 step = record.T_odom_cam.translation() - before.T_odom_cam.translation();
    const bool lost = failures.lost > 0;
    if (lost != IsLost(*this, size() - 1)) record.travelled += 0.5 * lost_path_m_;
    if (!lost) record.travelled += step.norm();
    failures.translation_m2 += before.failures.translation_m2;
    failures.rotation_rad2 += before.failures.rotation_rad2;
    failures.lost += before.failures.lost;
  }
  frames_.push_back(std::move(record));
  Changed(size() - 1);
}

OdometryFailures FailuresBetween(const FrameStore& frames, int a, int b) {
  return Difference(frames[a].failures, frames[b].failures);
}

bool IsLost(const FrameStore& frames, int index) {
  return index > 0 && FailuresBetween(frames, index - 1, index).lost > 0;
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
