// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// How far odometry is off over sub-paths, as the KITTI odometry benchmark has it.
struct SegmentError {
  int count = 0;                  ///< sub-paths; 0: the path is shorter than the shortest of them
  double translation = 0;         ///< mean of |translation error| / length
  double rotation_rad_per_m = 0;  ///< mean of rotation error / length
};

/// Geiger et al., Are we ready for autonomous driving?, CVPR 2012, and its development kit: from
/// each `every`-th frame, for each length, the sub-path that ends with the first frame further away
/// than that along the reference; its error (Q_i^-1 Q_j)^-1 (P_i^-1 P_j), with the reference Q and
/// the estimate P, divided by the (nominal) length; the mean over all of them. KITTI takes every
/// tenth frame and 100, 200, ... 800 m. Throws Error (kBadInput) where the lists are not of the
/// same length.
SegmentError ComputeSegmentError(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                                 const std::vector<double>& lengths_m, int every = 1);

}  // namespace sslcd
