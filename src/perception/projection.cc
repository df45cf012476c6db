// SPDX-License-Identifier: BSD-3-Clause
#include "perception/projection.h"

#include <algorithm>
#include <array>
#include <limits>

namespace sslcd {
namespace {

/// Corner i has the sign pattern of the bits of i, so an edge joins two corners that differ in one
/// bit.
std::array<Vec3, 8> Corners(const Pose& T_cam_object, const Vec3& dims, const Camera& camera) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 signs(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    corners[i] = T_cam_object * dims.cwiseProduct(signs).eval() + camera.offset;
  }
  return corners;
}

class Bounds {
 public:
  void Add(const Vec3& point, const Camera& camera) {
    const double u = camera.fx * point.x() / point.z() + camera.cx;
    const double v = camera.fy * point.y() / point.z() + camera.cy;
    box_ = {std::min(box_.left, u), std::min(box_.top, v), std::max(box_.right, u),
            std::max(box_.bottom, v)};
  }
  const Box2d& box() const { return box_; }

 private:
  static constexpr double kInf = std::numeric_limits<double>::infinity();
  Box2d box_{kInf, kInf, -kInf, -kInf};
};

}  // namespace

std::optional<Box2d> ProjectCuboid(const Pose& T_cam_object, const Vec3& dims, const Camera& camera,
                                   double near_m) {
  const std::array<Vec3, 8> corners = Corners(T_cam_object, dims, camera);
  if (!std::all_of(corners.begin(), corners.end(), [](const Vec3& c) { return c.allFinite(); }))
    return std::nullopt;

  // The cut cuboid is convex; its vertices are the corners in front of the plane and the edges'
  // points on it.
  Bounds bounds;
  for (int i = 0; i < 8; ++i) {
    const Vec3& a = corners[i];
    if (a.z() >= near_m) bounds.Add(a, camera);
    for (int bit : {1, 2, 4}) {
      if (i & bit) continue;
      const Vec3& b = corners[i | bit];
      if ((a.z() < near_m) == (b.z() < near_m)) continue;
      Vec3 cut = a + (near_m - a.z()) / (b.z() - a.z()) * (b - a);
      cut.z() = near_m;
      bounds.Add(cut, camera);
    }
  }

  Box2d box = bounds.box();
  if (camera.width > 0 && camera.height > 0) {
    box = {std::max(box.left, 0.), std::max(box.top, 0.), std::min<double>(box.right, camera.width),
           std::min<double>(box.bottom, camera.height)};
  }
  if (box.Area() <= 0) return std::nullopt;
  return box;
}

Box2d ProjectCuboidUnclipped(const Pose& T_cam_object, const Vec3& dims, const Camera& camera) {
  Bounds bounds;
  for (const Vec3& corner : Corners(T_cam_object, dims, camera)) bounds.Add(corner, camera);
  return bounds.box();
}

}  // namespace sslcd
