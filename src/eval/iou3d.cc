// SPDX-License-Identifier: BSD-3-Clause
#include "eval/iou3d.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sslcd {
namespace {

using Polygon = std::vector<Vec2>;  // counter-clockwise

double Cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners relative to `origin`, since large coordinates lose digits of the area.
Polygon Footprint(const Cuboid& box, const Vec3& origin) {
  const Vec2 centre(box.centre.x() - origin.x(), box.centre.y() - origin.y());
  const double c = std::cos(box.yaw), s = std::sin(box.yaw);
  const Vec2 along = 0.5 * box.dims.x() * Vec2(c, s);
  const Vec2 across = 0.5 * box.dims.y() * Vec2(-s, c);
  return {centre + along + across, centre - along + across, centre - along - across,
          centre + along - across};
}

/// The part of `polygon` to the left of the line from `a` to `b` (Sutherland and Hodgman 1974).
Polygon Clip(const Polygon& polygon, const Vec2& a, const Vec2& b) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& p = polygon[i];
    const Vec2& q = polygon[(i + 1) % polygon.size()];
    const double side_p = Cross(b - a, p - a), side_q = Cross(b - a, q - a);
    if (side_p >= 0) kept.push_back(p);
    if ((side_p > 0 && side_q < 0) || (side_p < 0 && side_q > 0)) {
      kept.push_back(p + side_p / (side_p - side_q) * (q - p));
    }
  }
  return kept;
}

double Area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * std::max(0., twice);
}

double VerticalOverlap(const Cuboid& a, const Cuboid& b) {
  const double top = std::min(a.centre.z() + 0.5 * a.dims.z(), b.centre.z() + 0.5 * b.dims.z());
  const double bottom = std::max(a.centre.z() - 0.5 * a.dims.z(), b.centre.z() - 0.5 * b.dims.z());
  return std::max(0., top - bottom);
}

bool IsEmpty(const Cuboid& box) { return !(box.dims.array() > 0).all(); }

}  // namespace

Cuboid ToCuboid(const Pose& T_world_object, const Vec3& dims, const GravityFrame& gravity) {
  return {gravity.Basis().transpose() * T_world_object.translation(),
          gravity.YawOf(T_world_object.so3()), dims};
}

double HorizontalDistance(const Cuboid& a, const Cuboid& b) {
  return (a.centre - b.centre).head<2>().norm();
}

double FootprintIntersection(const Cuboid& a, const Cuboid& b) {
  if (IsEmpty(a) || IsEmpty(b)) return 0.;
  Polygon common = Footprint(a, a.centre);
  const Polygon window = Footprint(b, a.centre);
  for (std::size_t i = 0; i < window.size() && !common.empty(); ++i) {
    common = Clip(common, window[i], window[(i + 1) % window.size()]);
  }
  return Area(common);
}

double Iou3d(const Cuboid& a, const Cuboid& b) {
  if (IsEmpty(a) || IsEmpty(b)) return 0.;
  const double common = FootprintIntersection(a, b) * VerticalOverlap(a, b);
  return std::clamp(common / (a.Volume() + b.Volume() - common), 0., 1.);
}

}  // namespace sslcd
