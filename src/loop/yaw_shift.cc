// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "loop/layout_likelihood.h"

namespace sslcd {

Vec3 Apply(const YawShift& pose, const Vec3& p) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  return {c * p.x() - s * p.y() + pose.t.x(), s * p.x() + c * p.y() + pose.t.y(),
          p.z() + pose.t.z()};
}

YawShift AlignPoints(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  Vec3 mean_from = Vec3::Zero(), mean_to = Vec3::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    mean_from += from[i] / static_cast<double>(from.size());
    mean_to += to[i] / static_cast<double>(from.size());
  }
  double dot = 0, cross = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 a = from[i] - mean_from, b = to[i] - mean_to;
    dot += a.x() * b.x() + a.y() * b.y();
    cross += a.x() * b.y() - a.y() * b.x();
  }
  YawShift pose;
  pose.yaw = std::atan2(cross, dot);
  pose.t = mean_to - Apply(pose, mean_from);
  return pose;
}

}  // namespace sslcd
