// SPDX-License-Identifier: BSD-3-Clause
#include "eval/path.h"

#include <cmath>

namespace sslcd {

std::vector<double> DistanceAlong(const std::vector<Pose>& poses) {
  std::vector<double> distance{0.};
  for (std::size_t i = 1; i < poses.size(); ++i)
    distance.push_back(distance.back() +
                       (poses[i].translation() - poses[i - 1].translation()).norm());
  return distance;
}

double HeadingOf(const Pose& T_world_cam) {
  const Vec3 view = T_world_cam.so3() * Vec3(Vec3::UnitZ());
  return std::atan2(view.x(), view.z());
}

}  // namespace sslcd
