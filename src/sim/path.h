// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd::sim {

/// A path segment of constant curvature; positive turns right, seen from above.
struct PathPiece {
  double length_m = 0;
  double curvature_per_m = 0;
};

/// A planar line in the x-z plane of the world, from the origin in direction +z. Arc length may be
/// negative (straight extension to the back) and longer than the segments (`closed`: they repeat;
/// otherwise straight extension).
class Path {
 public:
  explicit Path(std::vector<PathPiece> pieces, bool closed = false);

  double length() const { return length_; }

  /// Position and heading (angle from +z towards +x) of the line at arc length `s_m`.
  struct Point {
    double x = 0, z = 0, heading = 0;
  };
  Point At(double s_m) const;

  /// Camera on the line, looking along it. [T_world_cam]
  Pose CameraAt(double s_m) const;

  /// Upright object beside the line: `right_m` to its right, its centre at height coordinate `y_m`
  /// (down), turned by `turn_rad` to the right from the line's direction. [T_world_object]
  Pose ObjectAt(double s_m, double right_m, double y_m, double turn_rad) const;

 private:
  std::vector<PathPiece> pieces_;
  double length_ = 0;
  bool closed_;
};

}  // namespace sslcd::sim
