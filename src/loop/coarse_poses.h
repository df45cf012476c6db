// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/pose_search.h"

namespace sslcd {

/// Constants of the search for coarse poses. Set by hand for maps of cars, trees and poles with an
/// accuracy of some decimetres, without a recorded search.
inline constexpr double kMinPairM = 4.;  ///< closer objects do not determine the yaw [m]
/// largest difference of the distances of equal pairs [m]
inline constexpr double kPairNoiseM = 1.;
inline constexpr double kCoarseInlierM = 1.5;  ///< largest distance of matched objects [m]

/// A pose that two objects propose (local to global, with the local map's centre as origin) and its
/// score.
struct CoarsePose {
  float score = 0;             ///< soft count of coinciding objects
  float cosine = 1, sine = 0;  ///< of the yaw
  float x = 0, y = 0, z = 0;   ///< transformed centre [m]
};

/// Finds the best `options.refine` distinct poses, best first.
std::vector<CoarsePose> CoarsePoses(const std::vector<LayoutObject>& local, const Vec3& centre,
                                    const LayoutIndex& index, const PoseSearchOptions& options);

}  // namespace sslcd
