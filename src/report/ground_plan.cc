// SPDX-License-Identifier: BSD-3-Clause
#include "report/ground_plan.h"

#include <algorithm>

namespace sslcd {
namespace {

constexpr double kBorder = 8;  // around the points [m]

}  // namespace

Vec2 FromAbove(const Vec3& p, const GravityFrame& gravity) {
  return Vec2(gravity.forward.dot(p), gravity.left.dot(p));
}

GroundPlan::GroundPlan(const std::vector<Vec2>& points, double width_px) {
  low_ = high_ = points.empty() ? Vec2(0, 0) : points[0];
  for (const Vec2& p : points) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
  low_ -= Vec2(kBorder, kBorder);
  high_ += Vec2(kBorder, kBorder);
  Vec2 extent = high_ - low_;
  turned_ = extent.y() > extent.x();
  if (turned_) std::swap(extent.x(), extent.y());
  scale_ = width_px / extent.x();
  height_ = extent.y() * scale_;
}

Vec2 GroundPlan::operator()(const Vec2& p) const {
  if (turned_) return Vec2(p.y() - low_.y(), p.x() - low_.x()) * scale_;  // by a quarter turn
  return Vec2(p.x() - low_.x(), high_.y() - p.y()) * scale_;
}

std::vector<Vec2> GroundPlan::operator()(const std::vector<Vec2>& points) const {
  std::vector<Vec2> page;
  for (const Vec2& p : points) page.push_back((*this)(p));
  return page;
}

std::vector<Vec2> Footprint(const MapObject& object, const GravityFrame& gravity) {
  constexpr double kCorners[4][2] = {{.5, .5}, {.5, -.5}, {-.5, -.5}, {-.5, .5}};
  std::vector<Vec2> corners;
  for (const auto& [x, y] : kCorners)
    corners.push_back(FromAbove(
        object.T_world_object * Vec3(x * object.dims.x(), y * object.dims.y(), 0), gravity));
  return corners;
}

std::vector<Vec2> PathFromAbove(const Trajectory& trajectory, const GravityFrame& gravity) {
  std::vector<Vec2> path;
  for (const Pose& pose : trajectory.poses) path.push_back(FromAbove(pose.translation(), gravity));
  return path;
}

std::vector<Vec2> Thinned(const std::vector<Vec2>& points, double distance) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept.empty() || i + 1 == points.size() || !((points[i] - kept.back()).norm() < distance))
      kept.push_back(points[i]);
  return kept;
}

}  // namespace sslcd
