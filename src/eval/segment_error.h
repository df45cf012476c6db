// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Relative odometry error over sub-paths, as defined by the KITTI odometry benchmark.
struct SegmentError {
  int count = 0;                  ///< sub-paths; 0: the path is shorter than the shortest of them
  double translation = 0;         ///< mean of |translation error| / length
  double rotation_rad_per_m = 0;  ///< mean of rotation error / length
};

/// Source: Geiger et al., Are we ready for autonomous driving?, CVPR 2012, and its development kit.
/// A sub-path starts at each `every`-th frame, for each length; it ends with the first frame that
/// is farther away along the reference. Its error is (Q_i^-1 Q_j)^-1 (P_i^-1 P_j), with the
/// reference Q and the estimate P, divided by the nominal length. The result is the mean over all
/// sub-paths. KITTI takes every tenth frame and 100, 200, ... 800 m. Throws Error (kBadInput) if
/// the lists differ in length.
SegmentError ComputeSegmentError(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                                 const std::vector<double>& lengths_m, int every = 1);

}  // namespace sslcd
