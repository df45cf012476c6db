// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "lifting/object_scan.h"
#include "sslcd/lifting/lift.h"

namespace sslcd {

/// A side of a box: a place that the object's image touches, or one that it reaches and may go
/// beyond (the image's border, something in front).
struct BoxSides {
  bool left_open = false, top_open = false, right_open = false, bottom_open = false;
};

struct FitInput {
  Box2d box;
  BoxSides sides;
  Box2d sigmas;  ///< of its sides [px]
  std::vector<ScanPoint> scan;
  ClassPrior prior;
  std::vector<Footprint> taken;  ///< ground on which others stand
};

struct CuboidFit {
  Pose T_cam_object;  ///< in the left camera
  Vec3 dims{0, 0, 0};
  Footprint footprint;
  std::vector<ScanPoint> scan;  ///< what it was fitted to
  /// of the centre, in the left camera [m^2]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double yaw_sigma = 0;
  Vec3 dims_sigma{0, 0, 0};
  /// half the sum of squared, whitened residuals, and what taken ground costs
  double cost = 0;
  /// distance of a closed side of the box from the cuboid's, the largest [sigmas]
  double box_error = 0;
  /// distance of the scan's disparities from the cuboid's, the median [sigmas]
  double scan_error = 0;
};

/// Maximum a posteriori of position, yaw, size, height of the ground and the disparities' common
/// error, from twelve headings; ground that is taken counts against those that end there. The
/// covariance is that of all headings that explain what is seen, each with its likelihood. None
/// where no start converges.
std::optional<CuboidFit> FitCuboid(const FitInput& input, const StereoCamera& camera,
                                   const GroundFrame& ground);

}  // namespace sslcd
