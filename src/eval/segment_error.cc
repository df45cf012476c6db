// SPDX-License-Identifier: BSD-3-Clause
#include "eval/segment_error.h"

#include <algorithm>
#include <string>

#include "eval/path.h"
#include "sslcd/core/error.h"

namespace sslcd {

SegmentError ComputeSegmentError(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                                 const std::vector<double>& lengths_m, int every) {
  if (est.size() != ref.size())
    throw Error(ErrorKind::kBadInput, "the estimate has " + std::to_string(est.size()) +
                                          " poses and the reference " + std::to_string(ref.size()) +
                                          ": pair them first, with MatchByStamp()");
  SegmentError result;
  const std::vector<double> distance = DistanceAlong(ref);
  for (std::size_t i = 0; i < ref.size(); i += every) {
    for (const double length : lengths_m) {
      const auto end = std::upper_bound(distance.begin(), distance.end(), distance[i] + length);
      if (end == distance.end()) continue;
      const std::size_t j = end - distance.begin();
      const Pose error = (ref[i].inverse() * ref[j]).inverse() * (est[i].inverse() * est[j]);
      result.translation += error.translation().norm() / length;
      result.rotation_rad_per_m += error.so3().Log().norm() / length;
      ++result.count;
    }
  }
  if (result.count == 0) return result;
  result.translation /= result.count;
  result.rotation_rad_per_m /= result.count;
  return result;
}

}  // namespace sslcd
