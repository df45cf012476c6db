// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "lifting/object_scan.h"
#include "sslcd/lifting/lift.h"

namespace sslcd {

/// A side of a box. The object's image ends at a closed side. It may extend beyond an open side
/// (the image's border, an occluder).
struct BoxSides {
  bool left_open = false, top_open = false, right_open = false, bottom_open = false;
};

struct FitInput {
  Box2d box;
  BoxSides sides;
  Box2d sigmas;  ///< standard deviations of its sides [px]
  std::vector<ScanPoint> scan;
  ClassPrior prior;
  std::vector<Footprint> taken;  ///< ground occupied by other objects
};

struct CuboidFit {
  Pose T_cam_object;  ///< in the left camera's frame's frame's frame's frame's frame
  Vec3 dims{0, 0, 0};
  Footprint footprint;
  std::vector<ScanPoint> scan;  ///< scan points of the fit
  /// covariance of the centre in the left camera's axes [m^2]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double yaw_sigma = 0;
  Vec3 dims_sigma{0, 0, 0};
  /// half the sum of squared, whitened residuals, plus the penalty of occupied ground
  double cost = 0;
  /// largest distance of a closed side of the box from that of the cuboid's image [sigmas]
  double box_error = 0;
  /// median difference of the disparities of scan and cuboid [sigmas]
  double scan_error = 0;
};

/// Maximum a posteriori fit of position, yaw, size, height of the ground and common error of the
/// disparities, started from twelve headings. Fits on occupied ground get a penalty. The covariance
/// is that of the mixture of all plausible headings, weighted by likelihood. None: no start
/// converges.
std::optional<CuboidFit> FitCuboid(const FitInput& input, const StereoCamera& camera,
                                   const GroundFrame& ground);

}  // namespace sslcd
