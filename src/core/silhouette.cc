// SPDX-License-Identifier: BSD-3-Clause
#include "core/silhouette.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

bool Covers(const Silhouette& s, double bearing) { return s.left <= bearing && bearing <= s.right; }

}  // namespace

Silhouette SilhouetteOf(const Pose& T_cam_object, const Vec3& dims) {
  Silhouette silhouette{M_PI, -M_PI, T_cam_object.translation().norm()};
  Silhouette behind{2 * M_PI, 0, silhouette.range};  // bearings from 0 to 2 pi
  for (double x : {-0.5, 0.5}) {
    for (double y : {-0.5, 0.5}) {
      const Vec3 corner = T_cam_object * Vec3(x * dims.x(), y * dims.y(), 0);
      const double bearing = std::atan2(corner.x(), corner.z());
      const double turned = bearing < 0 ? bearing + 2 * M_PI : bearing;
      silhouette.left = std::min(silhouette.left, bearing);
      silhouette.right = std::max(silhouette.right, bearing);
      behind.left = std::min(behind.left, turned);
      behind.right = std::max(behind.right, turned);
    }
  }
  return silhouette.right - silhouette.left > M_PI ? behind : silhouette;
}

double VisibleFraction(const Silhouette& target, const std::vector<Silhouette>& all) {
  constexpr int kRays = 32;
  int visible = 0;
  for (int i = 0; i < kRays; ++i) {
    const double bearing = target.left + (i + 0.5) / kRays * (target.right - target.left);
    visible += std::none_of(all.begin(), all.end(), [&](const Silhouette& other) {
      return other.range < target.range &&
             (Covers(other, bearing) || Covers(other, bearing - 2 * M_PI) ||
              Covers(other, bearing + 2 * M_PI));
    });
  }
  return static_cast<double>(visible) / kRays;
}

}  // namespace sslcd
