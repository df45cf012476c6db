// SPDX-License-Identifier: BSD-3-Clause
#include "check/world_headings.h"

#include <cmath>

namespace sslcd::check {

std::vector<SameObject> SameObjects(const Sequence& sequence, const std::vector<FramePair>& pairs,
                                    double cap_m) {
  std::vector<SameObject> same;
  const MotionFunction motions = MotionsOf(sequence.poses);
  for (const FramePair& pair : pairs) {
    const Motion motion = motions(pair.first, pair.second);
    const Vec3 ahead = motion.R * Vec3(Vec3::UnitZ());
    // the scene turns against the camera
    const double turn = -std::atan2(ahead.x(), ahead.z());
    for (const Sight& sight : pair.before) {
      const Vec3 place = motion.R * sight.position + motion.t;
      const Sight* match = nullptr;
      int near = 0;
      for (const Sight& other : pair.after) {
        const double distance = (other.position - place).norm();
        if (other.label != sight.label || !(distance < cap_m)) continue;
        ++near;
        if (distance < 0.5 * cap_m) match = &other;
      }
      if (match && near == 1) same.push_back({sight.row, match->row, turn});
    }
  }
  return same;
}

double WorldTurn(const SameObject& object, double ry_before, double ry_after) {
  return WrapAngle(ry_after + object.camera_turn - ry_before);
}

}  // namespace sslcd::check
