// SPDX-License-Identifier: BSD-3-Clause
#include "loop/view_hull.h"

#include <algorithm>
#include <cmath>

#include "loop/convex_hull.h"

namespace sslcd {
namespace {

// Margin of the hull around the objects, since objects of a straight row lie on its edge. Set by
// hand. [m]
constexpr double kHullMargin = 1.;

}  // namespace

ViewHull::ViewHull(const std::vector<LayoutObject>& local) {
  std::vector<Vec2> points;
  for (const LayoutObject& object : local) points.push_back(object.position.head<2>());
  const std::vector<Vec2> corners = ConvexHull(points);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 along = corners[(i + 1) % corners.size()] - corners[i];
    edges_.push_back({corners[i], along, -kHullMargin * along.norm()});
  }
}

bool ViewHull::Contains(double x, double y) const {
  return std::all_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
    return !(edge.along.x() * (y - edge.from.y()) - edge.along.y() * (x - edge.from.x()) <
             edge.least);
  });
}

Eigen::AlignedBox2d ViewHull::BoxUnder(const YawShift& pose) const {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  Eigen::AlignedBox2d box;
  for (const Edge& edge : edges_) {
    const Vec2& p = edge.from;
    box.extend(Vec2(c * p.x() - s * p.y() + pose.t.x(), s * p.x() + c * p.y() + pose.t.y()));
  }
  const Vec2 margin(kHullMargin, kHullMargin);
  return {box.min() - margin, box.max() + margin};
}

}  // namespace sslcd
