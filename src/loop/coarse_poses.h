// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
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

/// Order of coarse poses: by score, of equal ones by place.
bool IsBetter(const CoarsePose& a, const CoarsePose& b);
/// Keeps the `most` best poses, in an unspecified order. The set does not depend on their order.
void KeepBest(std::size_t most, std::vector<CoarsePose>& poses);

/// What a search for coarse poses has found.
struct CoarseSearch {
  std::vector<CoarsePose> best;  ///< distinct, best first
  std::size_t looked_at = 0;     ///< number of poses that were scored
  /// log of the sum of the likelihoods of the poses that were scored and are not in `best`,
  /// relative to those that are; known in large maps only
  double left_out = -std::numeric_limits<double>::infinity();
};

/// Finds the best `options.refine` distinct poses.
CoarseSearch CoarsePoses(const std::vector<LayoutObject>& local, const Vec3& centre,
                         const LayoutIndex& index, const PoseSearchOptions& options);

}  // namespace sslcd
