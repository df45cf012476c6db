// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/pose_search.h"

namespace sslcd {

/// Of the search for coarse poses. Set by hand for maps of cars, trees and poles that are accurate
/// to some decimetres; no search over them is recorded.
inline constexpr double kMinPairM = 4.;    ///< objects that are closer fix the yaw too badly [m]
inline constexpr double kPairNoiseM = 1.;  ///< distances of equal pairs differ by less [m]
inline constexpr double kCoarseInlierM = 1.5;  ///< objects that fit are closer than this [m]

/// A pose that two objects propose, local to global with the local map's centre as origin, and how
/// many others agree.
struct CoarsePose {
  float score = 0;             ///< soft count of objects that fall on one another
  float cosine = 1, sine = 0;  ///< of the yaw
  float x = 0, y = 0, z = 0;   ///< where it takes the centre [m]
};

/// The best `options.refine` distinct ones, best first.
std::vector<CoarsePose> CoarsePoses(const std::vector<LayoutObject>& local, const Vec3& centre,
                                    const LayoutIndex& index, const PoseSearchOptions& options);

}  // namespace sslcd
