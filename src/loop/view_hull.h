// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sslcd/core/layout.h"

namespace sslcd {

/// The area that a local layout shows: the convex hull of its objects with a margin of 1 m. A map
/// object in it should have been seen. Fewer than two objects span no area: then each point counts
/// as inside, and the box is empty.
class ViewHull {
 public:
  explicit ViewHull(const std::vector<LayoutObject>& local);

  /// Whether a point of the local frame is in the area.
  bool Contains(double x, double y) const;

  /// Bounding box of the area in the map, if `pose` takes the local frame there.
  Eigen::AlignedBox2d BoxUnder(const YawShift& pose) const;

 private:
  struct Edge {
    Vec2 from, along;
    double least;  // smallest cross product with a point inside
  };
  std::vector<Edge> edges_;  // counter-clockwise
};

}  // namespace sslcd
