// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "loop/layout_likelihood.h"
#include "sslcd/loop/layout_match.h"

namespace sslcd {

inline LayoutObject ObjectAt(const Vec3& position, int label = 0) {
  LayoutObject object;
  object.position = position;
  object.label = label;
  object.yaw = std::nan("");
  return object;
}

/// `count` objects of three labels, strewn over a square.
inline std::vector<LayoutObject> Strewn(int count, double side_m, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return (random() % 1000001) * 1e-6; };
  std::vector<LayoutObject> objects;
  while (static_cast<int>(objects.size()) < count) {
    const double x = side_m * (uniform() - 0.5), y = side_m * (uniform() - 0.5),
                 z = 0.2 * uniform();
    objects.push_back(ObjectAt({x, y, z}, static_cast<int>(random() % 3)));
  }
  return objects;
}

/// The objects within `radius_m` of a point, as a map whose frame lies at `pose` in theirs.
inline std::vector<LayoutObject> SeenFrom(const std::vector<LayoutObject>& objects,
                                          const YawShift& pose, const Vec2& point, double radius_m,
                                          double noise_m, unsigned seed) {
  std::mt19937 random(seed);
  const auto noise = [&] { return noise_m * ((random() % 2000001) * 1e-6 - 1); };
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  std::vector<LayoutObject> seen;
  for (const LayoutObject& object : objects) {
    if ((object.position.head<2>() - point).norm() > radius_m) continue;
    const Vec3 d = object.position - pose.t;
    seen.push_back(object);
    seen.back().position =
        Vec3(c * d.x() + s * d.y() + noise(), -s * d.x() + c * d.y() + noise(), d.z());
  }
  return seen;
}

/// How far two poses take a point apart. [m]
inline double ShiftBetween(const YawShift& a, const YawShift& b, const Vec3& point) {
  return (Apply(a, point) - Apply(b, point)).norm();
}

}  // namespace sslcd
