// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/run_view.h"

namespace sslcd {

/// A world seen from above: [m] to the right of the page, and upwards on it.
Vec2 FromAbove(const Vec3& p, const GravityFrame& gravity);

/// Maps what is seen from above onto a part of a page: not mirrored, with equal scales, and with
/// the longer side lying flat.
class GroundPlan {
 public:
  /// `points` are to lie in a page of this width; its height follows. [px]
  GroundPlan(const std::vector<Vec2>& points, double width_px);

  double height() const { return height_; }  ///< [px]
  double scale() const { return scale_; }    ///< [px/m]
  Vec2 operator()(const Vec2& p) const;      ///< [px], y down
  std::vector<Vec2> operator()(const std::vector<Vec2>& points) const;

 private:
  Vec2 low_{0, 0}, high_{0, 0};
  double scale_ = 1, height_ = 1;
  bool turned_ = false;
};

/// The corners of an object from above.
std::vector<Vec2> Footprint(const MapObject& object, const GravityFrame& gravity);

/// The camera positions from above.
std::vector<Vec2> PathFromAbove(const Trajectory& trajectory, const GravityFrame& gravity);

/// The points without those that lie within `distance` of the one kept before; the last one stays.
std::vector<Vec2> Thinned(const std::vector<Vec2>& points, double distance);

}  // namespace sslcd
