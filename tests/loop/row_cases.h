// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "layout_cases.h"
#include "loop/layout_point.h"

namespace sslcd {

/// Cars in the rows of a car park, 2.5 m and 8 m apart, three places of five taken; three labels,
/// mostly 0. `rough_m`: largest distance from the middle of the place, per axis.
inline std::vector<LayoutObject> CarPark(const Vec2& middle, double rough_m, unsigned seed) {
  std::mt19937 random(seed);
  const auto rough = [&] { return rough_m * ((random() % 2001) * 1e-3 - 1); };
  std::vector<LayoutObject> cars;
  for (int column = -16; column <= 16; ++column)
    for (int row = -3; row <= 3; ++row) {
      if (random() % 5 >= 3) continue;
      const unsigned dice = random() % 25;
      const double x = 2.5 * column + rough(), y = 8 * row + rough();
      cars.push_back(ObjectAt({middle.x() + x, middle.y() + y, 0.1 * rough()},
                              dice < 20 ? 0 : (dice < 23 ? 1 : 2)));
    }
  return cars;
}

/// Several car parks side by side, all oriented alike, with ids.
inline std::vector<LayoutObject> CarParks(int count, unsigned seed) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<LayoutObject> all;
  for (int i = 0; i < count; ++i)
    for (LayoutObject& car : CarPark({105. * (i % columns), 75. * (i / columns)}, 0.3,
                                     seed + static_cast<unsigned>(i))) {
      car.id = static_cast<int>(all.size());
      all.push_back(car);
    }
  return all;
}

/// What is left of the objects if one in `every` is missed.
inline std::vector<LayoutObject> WithMisses(std::vector<LayoutObject> objects, std::size_t every) {
  for (std::size_t i = 0; i < objects.size(); i += every)
    objects.erase(objects.begin() + static_cast<std::ptrdiff_t>(i));
  return objects;
}

inline std::vector<LayoutPoint> PointsOf(const std::vector<LayoutObject>& objects) {
  std::vector<LayoutPoint> points;
  for (const LayoutObject& object : objects) {
    const Eigen::Vector3f p = object.position.cast<float>();
    points.push_back({p.x(), p.y(), p.z(), object.label});
  }
  return points;
}

/// The objects with their mean as origin; `mean` is where it was.
inline std::vector<LayoutPoint> CentredPoints(std::vector<LayoutObject> objects, Vec3& mean) {
  mean = Vec3::Zero();
  for (const LayoutObject& object : objects)
    mean += object.position / static_cast<double>(objects.size());
  for (LayoutObject& object : objects) object.position -= mean;
  return PointsOf(objects);
}

}  // namespace sslcd
