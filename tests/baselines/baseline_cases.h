// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "baselines/answer.h"
#include "loop/layout_likelihood.h"

namespace sslcd::baselines {

inline LayoutObject At(double x, double y, int label = 0) {
  LayoutObject object;
  object.position = Vec3(x, y, 0);
  object.label = label;
  return object;
}

/// Objects of `labels` labels strewn over a square.
inline std::vector<LayoutObject> Strewn(int count, double side_m, int labels, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return (random() % 1000001) * 1e-6; };
  std::vector<LayoutObject> objects;
  for (int i = 0; i < count; ++i) {
    const double x = side_m * uniform(), y = side_m * uniform();
    objects.push_back(At(x, y, static_cast<int>(random() % labels)));
  }
  return objects;
}

/// The objects within `radius_m` of a point, in a frame that lies at `pose` in theirs; off by up to
/// `noise_m`.
inline std::vector<LayoutObject> SeenFrom(const std::vector<LayoutObject>& objects,
                                          const YawShift& pose, const Vec2& point, double radius_m,
                                          double noise_m) {
  std::mt19937 random(7);
  const auto noise = [&] { return noise_m * ((random() % 2000001) * 1e-6 - 1); };
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  std::vector<LayoutObject> seen;
  for (const LayoutObject& object : objects) {
    if (!((object.position.head<2>() - point).norm() <= radius_m)) continue;
    const Vec3 d = object.position - pose.t;
    seen.push_back(object);
    seen.back().position =
        Vec3(c * d.x() + s * d.y() + noise(), -s * d.x() + c * d.y() + noise(), d.z());
  }
  return seen;
}

inline const double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace sslcd::baselines
