// SPDX-License-Identifier: BSD-3-Clause
#include "check/object_turns.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace sslcd::check {
namespace {

constexpr double kNearest = 3, kFarthest = 25;  // [m]
constexpr std::size_t kLeastAngles = 2;

/// The only row of the label within the cap; null: none, or several.
const Row* OnlyNear(const std::vector<const Row*>& rows, const std::string& label,
                    const Vec3& place, double cap_m) {
  const Row* only = nullptr;
  for (const Row* row : rows) {
    if (row->detection.label != label ||
        !((row->detection.T_cam_object.translation() - place).norm() < cap_m))
      continue;
    if (only) return nullptr;
    only = row;
  }
  return only;
}

}  // namespace

double OdometryTurn(const std::vector<Pose>& poses, int frame) {
  const auto i = static_cast<std::size_t>(frame);
  const Vec3 ahead = (poses[i].so3().inverse() * poses[i - 1].so3()) * Vec3(Vec3::UnitZ());
  return -std::atan2(ahead.x(), ahead.z());
}

std::vector<ObjectTurn> TurnsOfObjects(const Sequence& sequence, double cap_m) {
  std::vector<ObjectTurn> turns;
  const auto frames = RowsByFrame(sequence);
  for (int frame = 1; frame < sequence.frames(); ++frame) {
    const auto i = static_cast<std::size_t>(frame);
    if (sequence.steps[i] && sequence.steps[i]->lost) continue;
    const Vec3 step(0, 0,
                    (sequence.poses[i].translation() - sequence.poses[i - 1].translation()).norm());
    std::vector<double> angles;
    for (const Row* before : frames[i - 1]) {
      const Vec3 from = before->detection.T_cam_object.translation();
      if (!(from.z() > kNearest && from.norm() < kFarthest)) continue;
      const Row* after = OnlyNear(frames[i], before->detection.label, from - step, cap_m);
      if (!after) continue;
      const Vec3 to = after->detection.T_cam_object.translation();
      if (!OnlyNear(frames[i - 1], before->detection.label, to + step, cap_m)) continue;
      angles.push_back(-std::atan2(to.x() - from.x(), from.z()));
    }
    if (angles.size() < kLeastAngles) continue;
    const int objects = static_cast<int>(angles.size());
    turns.push_back({frame, Median(std::move(angles)), objects});
  }
  return turns;
}

}  // namespace sslcd::check
