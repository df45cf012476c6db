// SPDX-License-Identifier: BSD-3-Clause
#include "sim/path.h"

#include <cmath>

namespace sslcd::sim {
namespace {

/// A point on an arc, in closed form.
Path::Point Advance(const Path::Point& from, double length, double curvature) {
  const double turn = length * curvature;
  // sin(turn/2)/(turn/2) times the length is the chord; its direction is half the turn away.
  const double half = 0.5 * turn;
  const double chord = std::abs(half) < 1e-9 ? length : length * std::sin(half) / half;
  return {from.x + chord * std::sin(from.heading + half),
          from.z + chord * std::cos(from.heading + half), from.heading + turn};
}

}  // namespace

Path::Path(std::vector<PathPiece> pieces, bool closed)
    : pieces_(std::move(pieces)), closed_(closed) {
  for (const PathPiece& piece : pieces_) length_ += piece.length_m;
}

Path::Point Path::At(double s_m) const {
  if (closed_) s_m -= length_ * std::floor(s_m / length_);
  if (s_m <= 0) return {0, s_m, 0};
  Point point;
  for (const PathPiece& piece : pieces_) {
    if (s_m <= piece.length_m) return Advance(point, s_m, piece.curvature_per_m);
    point = Advance(point, piece.length_m, piece.curvature_per_m);
    s_m -= piece.length_m;
  }
  return Advance(point, s_m, 0);
}

Pose Path::CameraAt(double s_m) const {
  const Point point = At(s_m);
  return Pose(lie::SO3<double>::RotY(point.heading), Vec3(point.x, 0, point.z));
}

Pose Path::ObjectAt(double s_m, double right_m, double y_m, double turn_rad) const {
  const Point point = At(s_m);
  const Vec3 position(point.x + right_m * std::cos(point.heading), y_m,
                      point.z - right_m * std::sin(point.heading));
  // Yaw counts from +x towards +z (GravityFrame of KITTI axes), the heading from +z towards +x.
  return Pose(GravityFrame().Upright(0.5 * M_PI - point.heading - turn_rad), position);
}

}  // namespace sslcd::sim
