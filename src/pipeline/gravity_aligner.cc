// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/gravity_aligner.h"

#include <algorithm>
#include <cmath>

namespace sslcd {

Pose GravityAligner::Align(const Pose& T_odom_cam) {
  if (!raw_) {
    level_ = T_odom_cam;
    up_in_cam_ = T_odom_cam.so3().inverse() * gravity_.up;
    mean_up_ = gravity_.up;
  } else {
    const Pose step = raw_->inverse() * T_odom_cam;
    level_ = level_ * step;
    const double share = std::min(1., step.translation().norm() / options_.window_m);
    mean_up_ = ((1 - share) * mean_up_ + share * (level_.so3() * up_in_cam_)).normalized();
    const Vec3 axis = mean_up_.cross(gravity_.up);
    const double tilt = std::atan2(axis.norm(), mean_up_.dot(gravity_.up));
    if (options_.enabled && tilt > options_.max_slope_rad) {
      // The excess of the mean belongs to the whole segment: this step corrects its share.
      const auto turn =
          lie::SO3<double>::Exp((share * (tilt - options_.max_slope_rad)) * axis.normalized());
      level_.so3() = turn * level_.so3();
    }
    level_.normalise();
  }
  raw_ = T_odom_cam;
  return level_;
}

}  // namespace sslcd
